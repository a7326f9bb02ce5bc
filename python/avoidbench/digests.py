"""Digests over what a database holds of trials (lib/bench/store/row_digest.hpp), against accidents and edits."""

from __future__ import annotations

import hashlib
import sqlite3
import struct
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from avoidbench.database_file import damaged

# Of trials without metrics; without attempt and run_id, which follow from the file that the trial is in.
_OF_TRIALS = (
    "end_time_s",
    "flight_digest",
    "map_key",
    "mission_index",
    "outcome",
    "planner_key",
    "reason",
    "spec_json",
    "trial_key",
    "wall_time_s",
)
_OF_EXPLANATIONS = ("cause", "facts_json", "record_digest", "rules_version", "trial_key")


def digest_of(values: Iterable[tuple[str, Any]]) -> str:
    """SHA-256 of a length and the bytes: name, SQLite's type and value of each column that is not NULL."""
    covered = bytearray()
    for name, value in values:
        if value is None:
            continue
        covered += struct.pack("<Q", len(name)) + name.encode()
        if isinstance(value, int):
            covered += struct.pack("<Qq", 1, value)
        elif isinstance(value, float):
            covered += struct.pack("<Qd", 2, value)
        else:
            text = str(value).encode()
            covered += struct.pack("<QQ", 3, len(text)) + text
    return hashlib.sha256(struct.pack("<Q", len(covered)) + covered).hexdigest()


def _check_rows(connection: sqlite3.Connection, path: Path, table: str, columns: Iterable[str]) -> None:
    cursor = connection.execute(f"SELECT * FROM {table}")
    places = {column[0]: i for i, column in enumerate(cursor.description)}
    covered = [(name, places[name]) for name in sorted(columns) if name in places]  # older files lack some
    key, stored = places["trial_key"], places.get("row_digest")
    for row in cursor:
        if stored is None or row[stored] is None:
            raise damaged(path, table, row[key], "it has no row_digest: it was removed")
        if row[stored] != digest_of((name, row[i]) for name, i in covered):
            raise damaged(path, table, row[key], "its values are not those that were stored (row_digest)")


def check_trials(connection: sqlite3.Connection, path: Path) -> None:
    """Checks every trial of the file, and what explains it, against its row_digest.

    Raises:
        ResultsError: they differ, or there is no digest.
    """
    metrics = [row[0] for row in connection.execute("SELECT name FROM metric_definitions")]
    _check_rows(connection, path, "trials", (*_OF_TRIALS, *metrics))
    _check_rows(connection, path, "explanations", _OF_EXPLANATIONS)
