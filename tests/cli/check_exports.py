#!/usr/bin/env python3
"""Checks what `avoidbench export` wrote against the formats' own rules and against the database, read by SQLite itself.

usage: check_exports.py trials DB FILE.csv | worst DB FILE.csv METRIC COUNT | tum FILE… | same DB ID FILE.csv"""

import csv
import io
import math
import pathlib
import sqlite3
import struct
import sys
import zlib


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


def check_worst(database, file, metric, count):
    """The trials with the least values of a metric, in order, those without it last."""
    connection = sqlite3.connect(database)
    every = connection.execute(f"SELECT trial_id, {metric} FROM trial_table").fetchall()
    values = sorted((value is None, value) for _, value in every)[: int(count)]
    rows = list(csv.DictReader(io.StringIO(pathlib.Path(file).read_text(), newline="")))
    check([float(row[metric]) for row in rows] == [value for _, value in values], "other trials or another order")
    check(all((int(row["trial_id"]), float(row[metric])) in every for row in rows), "ids are not the database's")
    check(all(row["start_x_m"] and row["goal_z_m"] for row in rows), "no start or goal")
    print(f"{count} of {len(every)} trials, {metric} from the least on")


def check_tum(files):
    """As evo reads it: lines of eight numbers parted by single spaces, comments begin with #; times rise, |q| = 1."""
    for file in files:
        last = -math.inf
        lines = [line for line in pathlib.Path(file).read_text().split("\n") if not line.startswith("#")]
        check(lines.pop() == "", f"{file}: the last line has no end")
        check(len(lines) > 10, f"{file}: {len(lines)} samples")
        for line in lines:
            words = line.split(" ")
            check(len(words) == 8, f"{file}: {line}")
            values = [float(word) for word in words]
            check(values[0] > last, f"{file}: time {values[0]} after {last}")
            last = values[0]
            check(abs(math.hypot(*values[4:]) - 1) < 1e-9, f"{file}: {line}")
    print(f"{len(files)} trajectories")


def check_same(database, trial_id, file):
    """The samples that schema.sql describes, unpacked here."""
    connection = sqlite3.connect(database)
    count, blob = connection.execute(
        "SELECT sample_count, samples FROM trajectories JOIN trials USING (trial_key) WHERE trials.rowid = ?",
        (trial_id,),
    ).fetchone()
    planes = zlib.decompress(blob)
    samples = [
        [struct.unpack("<d", bytes(planes[(n * 8 + byte) * count + i] for byte in range(8)))[0] for n in range(22)]
        for i in range(count)
    ]
    names = (
        "time_s x_m y_m z_m vx_mps vy_mps vz_mps ax_mps2 ay_mps2 az_mps2 qw qx qy qz rate_x_body_radps "
        "rate_y_body_radps "
        "rate_z_body_radps reference_x_m reference_y_m reference_z_m clearance_m rotor_power_w"
    ).split()
    rows = list(csv.DictReader(open(file, newline="")))
    check(len(rows) == count, f"{len(rows)} rows, {count} samples")
    for row, sample in zip(rows, samples):
        for name, value in zip(names, sample):
            text = row[name]
            same = text == "" if math.isnan(value) else float(text) == value
            check(same, f"{name}: {text}, stored {value}")
        yaw = math.atan2(
            2 * (sample[10] * sample[13] + sample[11] * sample[12]), 1 - 2 * (sample[12] ** 2 + sample[13] ** 2)
        )
        check(abs(math.remainder(float(row["yaw_rad"]) - yaw, 2 * math.pi)) < 1e-9, f"yaw {row['yaw_rad']}, {yaw}")
    print(f"{count} samples, as in the database")


def main():
    what, *arguments = sys.argv[1:]
    if what == "trials":
        check_trials(*arguments)
    elif what == "worst":
        check_worst(*arguments)
    elif what == "tum":
        check_tum(arguments)
    elif what == "same":
        check_same(*arguments)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
