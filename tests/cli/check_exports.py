#!/usr/bin/env python3
"""Checks what `avoidbench export trials` wrote against the database, read by SQLite itself.

usage: check_exports.py DB FILE.csv"""

import csv
import io
import pathlib
import sqlite3
import struct
import sys


def check(condition, message):
    if not condition:
        sys.exit(message)


def check_trials(database, file):
    """Every value of the view trial_table, bit for bit."""
    raw = pathlib.Path(file).read_bytes()
    check(raw.count(b"\r\n") == raw.count(b"\n"), "a line does not end with CR LF")
    rows = list(csv.DictReader(io.StringIO(raw.decode(), newline=""), strict=True))
    connection = sqlite3.connect(database)
    connection.row_factory = sqlite3.Row
    truth = {row["trial_key"]: row for row in connection.execute("SELECT * FROM trial_table")}
    check(len(rows) == len(truth), f"{len(rows)} rows, {len(truth)} trials")
    for row in rows:
        stored = truth[row["trial_key"]]
        # Without what no map of the sweep has, and with its axes.
        missing = set(stored.keys()) - set(row)
        check(all(one[name] is None for one in truth.values() for name in missing), f"without {missing}")
        for name, text in row.items():
            if name not in stored.keys():
                continue
            value = stored[name]
            if value is None:
                same = text == ""
            elif isinstance(value, str):
                same = text == value
            elif name == "map_seed":
                same = int(text) == value % 2**64
            else:
                same = struct.pack("<d", float(text)) == struct.pack("<d", float(value))
            check(same, f"{row['trial_key'][:12]} {name}: {text!r}, stored {value!r}")
    print(f"{len(rows)} trials, as in the database")


if __name__ == "__main__":
    check_trials(*sys.argv[1:])
