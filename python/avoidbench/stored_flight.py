"""What the database holds of one flight: path, planner calls, events; checked by its digests."""

from __future__ import annotations

import hashlib
import json
import math
import sqlite3
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from avoidbench.database_file import damaged
from avoidbench.digests import digest_of

FloatArray = npt.NDArray[np.float64]

# Of one stored sample, in their order (lib/bench/store/schema.sql).
_STORED = (
    "time_s",
    "x_m",
    "y_m",
    "z_m",
    "vx_mps",
    "vy_mps",
    "vz_mps",
    "ax_mps2",
    "ay_mps2",
    "az_mps2",
    "qw",
    "qx",
    "qy",
    "qz",
    "rate_x_body_radps",
    "rate_y_body_radps",
    "rate_z_body_radps",
    "reference_x_m",
    "reference_y_m",
    "reference_z_m",
    "clearance_m",
    "rotor_power_w",
)
_SAMPLE_BYTES = 8 * len(_STORED)
# As `avoidbench export trajectory` has them.
TRAJECTORY_COLUMNS = (*_STORED[:14], "yaw_rad", *_STORED[14:20], "rotor_power_w", "clearance_m")
CALL_COLUMNS = ("call_index", "time_s", "status", "command_kind", "cpu_time_s", "wall_time_s", "latency_s")
EVENT_COLUMNS = ("event_index", "kind", "time_s", "speed_mps", "obstacle_index", "obstacle_kind")

# ab_status and the kinds of ab_command (lib/sdk/planner_api/avoidbench/planner.h).
_STATUSES = {0: "command", 1: "no_plan", 2: "gave_up"}
_COMMAND_KINDS = {1: "position", 2: "velocity", 4: "acceleration", 8: "trajectory", 16: "rates"}


def _row(connection: sqlite3.Connection, table: str, key: str) -> dict[str, Any] | None:
    """A trial's row of a table, by the names of its columns: older files lack some."""
    cursor = connection.execute(f"SELECT * FROM {table} WHERE trial_key = ?", (key,))
    found = cursor.fetchone()
    return None if found is None else dict(zip((c[0] for c in cursor.description), found))


def _event_rows(connection: sqlite3.Connection, key: str) -> list[tuple[Any, ...]]:
    return connection.execute(
        f"SELECT {', '.join(EVENT_COLUMNS)} FROM events WHERE trial_key = ? ORDER BY event_index", (key,)
    ).fetchall()


def check_flight(connection: sqlite3.Connection, path: Path, key: str) -> None:
    """Checks counts and digests of a flight and its events against the trial's flight_digest.

    Raises:
        ResultsError: they differ.
    """
    trial = _row(connection, "trials", key) or {}
    covered: list[tuple[str, Any]] = []
    for table, columns in (
        ("trajectories", ("sample_count", "samples_digest")),
        ("plan_calls", ("call_count", "calls_digest")),
    ):
        row = connection.execute(f"SELECT {', '.join(columns)} FROM {table} WHERE trial_key = ?", (key,)).fetchone()
        if row is not None:
            covered += zip(columns, row)
    for event in _event_rows(connection, key):
        covered += zip(EVENT_COLUMNS, event)
    if digest_of(covered) != trial.get("flight_digest"):
        raise damaged(
            path, "trials", key, "its trajectory, plan calls or events are not those that were stored (flight_digest)"
        )


def _unpacked(packed: bytes, count: int) -> bytes | None:
    """The samples one after the other; None if `packed` has another number of them."""
    unpacker = zlib.decompressobj()
    try:
        planes = unpacker.decompress(packed, count * _SAMPLE_BYTES + 1)
    except zlib.error:
        return None
    if len(planes) != count * _SAMPLE_BYTES:
        return None
    by_byte = np.frombuffer(planes, "u1").reshape(len(_STORED), 8, count)
    return by_byte.transpose(2, 0, 1).tobytes()


def _samples(connection: sqlite3.Connection, path: Path, key: str) -> FloatArray:
    """(sample_count, 22) in the order of _STORED."""
    row = _row(connection, "trajectories", key)
    if row is None:
        return np.empty((0, len(_STORED)))
    count, stored = int(row["sample_count"]), bytes(row["samples"])
    raw = _unpacked(stored, count) if count >= 0 else None
    if raw is None or len(raw) != count * _SAMPLE_BYTES:
        raise damaged(path, "trajectories", key, "its samples can't be unpacked")
    if hashlib.sha256(raw).hexdigest() != row["samples_digest"]:
        raise damaged(path, "trajectories", key, "its samples are not those that were stored (samples_digest)")
    return np.frombuffer(raw, "<f8").reshape(count, len(_STORED)).astype(np.float64)


def read_trajectory(connection: sqlite3.Connection, path: Path, key: str) -> pd.DataFrame:
    """The flown path: sample_count rows with TRAJECTORY_COLUMNS, all float64."""
    check_flight(connection, path, key)
    samples = _samples(connection, path, key)
    columns = {name: samples[:, i] for i, name in enumerate(_STORED)}
    qw, qx, qy, qz = (columns[name] for name in ("qw", "qx", "qy", "qz"))
    columns["yaw_rad"] = np.arctan2(2.0 * (qx * qy + qw * qz), 1.0 - 2.0 * (qy * qy + qz * qz))
    return pd.DataFrame({name: columns[name] for name in TRAJECTORY_COLUMNS})


def _number(value: Any) -> float:
    return math.nan if value is None else float(value)


def read_calls(connection: sqlite3.Connection, path: Path, key: str) -> pd.DataFrame:
    """The planner's calls: a row each with CALL_COLUMNS."""
    check_flight(connection, path, key)
    row = _row(connection, "plan_calls", key)
    calls: list[list[Any]] = []
    if row is not None:
        try:
            calls = json.loads(row["calls_json"])
            digested = b"".join(
                struct.pack("<dQQ", _number(time_s), status & 0xFFFFFFFF, kind)
                for time_s, _, _, status, kind, *_ in calls
            )
        except (ValueError, TypeError, struct.error) as error:
            raise damaged(path, "plan_calls", key, "calls_json is no list of plan calls") from error
        is_whole = row["call_count"] == len(calls)
        if not is_whole or hashlib.sha256(digested).hexdigest() != row["calls_digest"]:
            raise damaged(path, "plan_calls", key, "its calls are not those that were stored (calls_digest)")
    kinds = [_COMMAND_KINDS.get(call[4], f"kind {call[4]}") if call[3] == 0 else None for call in calls]
    return pd.DataFrame(
        {
            "call_index": np.arange(len(calls), dtype=np.int64),
            "time_s": np.array([_number(call[0]) for call in calls], dtype=np.float64),
            "status": pd.Series([_STATUSES.get(call[3], "error") for call in calls], dtype=object),
            "command_kind": pd.Series(kinds, dtype=object),
            "cpu_time_s": np.array([_number(call[1]) for call in calls], dtype=np.float64),
            "wall_time_s": np.array([_number(call[2]) for call in calls], dtype=np.float64),
            "latency_s": np.array(
                [_number(call[5]) if len(call) > 5 else math.nan for call in calls], dtype=np.float64
            ),
        }
    )


def read_events(connection: sqlite3.Connection, path: Path, key: str) -> pd.DataFrame:
    """The events of a flight: a row each with EVENT_COLUMNS."""
    check_flight(connection, path, key)
    frame = pd.DataFrame(_event_rows(connection, key), columns=list(EVENT_COLUMNS))
    return frame.astype(
        {
            "event_index": np.int64,
            "kind": object,
            "time_s": np.float64,
            "speed_mps": np.float64,
            "obstacle_index": np.int64,
            "obstacle_kind": object,
        }
    )
