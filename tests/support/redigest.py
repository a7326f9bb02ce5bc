#!/usr/bin/env python3
"""Gives each trial of a database the digests of what the file now holds, as a program would that had stored it so.

redigest.py DB
"""

import hashlib
import sqlite3
import struct
import sys

EVENTS = "event_index, kind, time_s, speed_mps, obstacle_index, obstacle_kind"


def digested(names, values):
    """Name, SQLite's type and bytes of each value that is not NULL; texts with their length before them."""
    covered = b""
    for name, value in zip(names, values):
        if value is None:
            continue
        covered += struct.pack("<Q", len(name)) + name.encode()
        if isinstance(value, int):
            covered += struct.pack("<Qq", 1, value)
        elif isinstance(value, float):
            covered += struct.pack("<Qd", 2, value)
        else:
            text = value.encode() if isinstance(value, str) else value
            covered += struct.pack("<QQ", 3 if isinstance(value, str) else 4, len(text)) + text
    return covered


def hex_of(covered):
    return hashlib.sha256(struct.pack("<Q", len(covered)) + covered).hexdigest()


def redigest(database):
    def covered_by(sql, key):
        cursor = database.execute(sql, (key,))
        names = [column[0] for column in cursor.description]
        return b"".join(digested(names, row) for row in cursor)

    columns = sorted(
        {row[1] for row in database.execute("PRAGMA table_info(trials)")} - {"attempt", "run_id", "row_digest"}
    )
    of_trial = ", ".join(f'"{column}"' for column in columns)
    for (key,) in database.execute("SELECT trial_key FROM trials").fetchall():
        flight = hex_of(
            covered_by("SELECT sample_count, samples_digest FROM trajectories WHERE trial_key = ?", key)
            + covered_by("SELECT call_count, calls_digest FROM plan_calls WHERE trial_key = ?", key)
            + covered_by(f"SELECT {EVENTS} FROM events WHERE trial_key = ? ORDER BY event_index", key)
        )
        database.execute("UPDATE trials SET flight_digest = ? WHERE trial_key = ?", (flight, key))
        row = hex_of(covered_by(f"SELECT {of_trial} FROM trials WHERE trial_key = ?", key))
        database.execute("UPDATE trials SET row_digest = ? WHERE trial_key = ?", (row, key))


if __name__ == "__main__":
    connection = sqlite3.connect(sys.argv[1])
    redigest(connection)
    connection.commit()
    connection.close()
