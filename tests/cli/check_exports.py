#!/usr/bin/env python3
"""Checks what `avoidbench export` wrote against the formats' own rules and against the database, read by SQLite itself.

usage: check_exports.py trials DB FILE.csv | worst DB FILE.csv METRIC COUNT | tum FILE… | same DB ID FILE.csv | ompl DB FILE.log…
"""
import csv
import io
import math
import pathlib
import re
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
    count, blob, is_packed = connection.execute(
        "SELECT sample_count, samples, is_packed FROM trajectories JOIN trials USING (trial_key) WHERE trials.rowid = ?",
        (trial_id,)).fetchone()
    check(is_packed == 1, "not packed")
    planes = zlib.decompress(blob)
    samples = [[struct.unpack("<d", bytes(planes[(n * 8 + byte) * count + i] for byte in range(8)))[0] for n in range(22)]
               for i in range(count)]
    names = ("time_s x_m y_m z_m vx_mps vy_mps vz_mps ax_mps2 ay_mps2 az_mps2 qw qx qy qz rate_x_body_radps rate_y_body_radps "
             "rate_z_body_radps reference_x_m reference_y_m reference_z_m clearance_m rotor_power_w").split()
    rows = list(csv.DictReader(open(file, newline="")))
    check(len(rows) == count, f"{len(rows)} rows, {count} samples")
    for row, sample in zip(rows, samples):
        for name, value in zip(names, sample):
            text = row[name]
            same = text == "" if math.isnan(value) else float(text) == value
            check(same, f"{name}: {text}, stored {value}")
        yaw = math.atan2(2 * (sample[10] * sample[13] + sample[11] * sample[12]),
                         1 - 2 * (sample[12] ** 2 + sample[13] ** 2))
        check(abs(math.remainder(float(row["yaw_rad"]) - yaw, 2 * math.pi)) < 1e-9, f"yaw {row['yaw_rad']}, {yaw}")
    print(f"{count} samples, as in the database")


class OmplLog:
    """A benchmark log read by the grammar of OMPL's manual ("The benchmark logfile format"), and by nothing else.

    Beside the grammar: names of properties are words of letters, digits and _, as Planner Arena's database needs for its
    columns; the type ENUM, that OMPL writes for its own `status`; a semicolon behind each progress sample, as OMPL writes.
    """
    NUMBER = r"-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
    DATA = rf"(?:{NUMBER}|inf|nan|)"

    def __init__(self, text):
        check(text.endswith("\n") and "\r" not in text, "lines end with a newline")
        self.lines = text.split("\n")[:-1]
        self.at = 0
        self.preamble()
        self.planners = [self.planner() for _ in range(self.planner_count)]
        check(self.at == len(self.lines), f"line {self.at + 1}: more than the grammar takes")

    def line(self, pattern):
        """The groups of the next line, which has to be exactly so."""
        check(self.at < len(self.lines), "the log ends early")
        found = re.fullmatch(pattern, self.lines[self.at])
        check(found, f"line {self.at + 1}: {self.lines[self.at]!r} is not {pattern}")
        self.at += 1
        return found.groups()

    def next_is(self, pattern):
        return re.fullmatch(pattern, self.lines[self.at]) is not None

    def multi_line_string(self):
        self.line(r"<<<\|")
        text = []
        while not self.next_is(r"\|>>>"):
            text += self.line(r"(.+)")
        self.line(r"\|>>>")
        check(text, "an empty string in several lines")
        return text

    def preamble(self):
        self.library, self.version = self.line(r"(\S+) version (\S+)")
        self.name, = self.line(r"Experiment (\S+)")
        self.properties = {}
        if self.next_is(r"\d+ experiment properties"):
            count, = self.line(r"(\d+) .*")
            for _ in range(int(count)):
                name, _, value = self.line(rf"([A-Za-z_][A-Za-z0-9_]*) (BOOLEAN|INTEGER|REAL) = ({self.NUMBER})")
                self.properties[name] = float(value)
        self.host, = self.line(r"Running on (\S+)")
        self.date, = self.line(r"Starting at (\d{4}-\d\d-\d\d \d\d:\d\d:\d\d)")
        self.setup = self.multi_line_string()
        self.cpu = self.multi_line_string()
        self.seed, = self.line(r"(\d+) is the random seed")
        self.time_limit, = self.line(rf"({self.NUMBER}) seconds per run")
        self.line(rf"({self.NUMBER}) MB per run")
        self.run_count, = self.line(r"(\d+) runs per planner")
        self.line(rf"({self.NUMBER}) seconds spent to collect the data")
        count, = self.line(r"(\d+) enum types?")
        self.enums = {}
        for _ in range(int(count)):
            words = self.line(r"([A-Za-z_][A-Za-z0-9_]*(?:\|[^|\s]+)+)")[0].split("|")
            self.enums[words[0]] = words[1:]
        count, = self.line(r"(\d+) planners")
        self.planner_count = int(count)

    def properties_of(self, words):
        count, = self.line(rf"(\d+) {words}")
        found = [self.line(r"([A-Za-z_][A-Za-z0-9_]*) (BOOLEAN|INTEGER|REAL|ENUM)") for _ in range(int(count))]
        check(len({name for name, _ in found}) == len(found), "a property twice")
        return found

    def value(self, text, name, kind):
        if text in ("", "nan", "inf"):
            return None
        number = float(text)
        if kind == "BOOLEAN":
            check(text in ("0", "1"), f"{name}: {text}")
        if kind in ("INTEGER", "ENUM"):
            check(number == int(number), f"{name}: {text}")
        if kind == "ENUM":
            check(0 <= int(number) < len(self.enums[name]), f"{name}: {text}")
        return number

    def planner(self):
        name, = self.line(r"(\S+)")
        count, = self.line(r"(\d+) common properties")
        common = dict(self.line(r"(\S[^=]*?) = (\S+)") for _ in range(int(count)))
        properties = self.properties_of("properties for each run")
        count, = self.line(r"(\d+) runs")
        runs = []
        for _ in range(int(count)):
            text, = self.line(rf"((?:{self.DATA}; )+)")
            values = text.split("; ")[:-1]
            check(len(values) == len(properties), f"{len(values)} values, {len(properties)} properties")
            runs.append({name: self.value(value, name, kind) for (name, kind), value in zip(properties, values)})
        progress = []
        if not self.next_is(r"\."):
            series = self.properties_of("progress properties for each run")
            self.line(rf"{count} runs")
            for _ in runs:
                text, = self.line(rf"((?:(?:{self.DATA},)+;)+)")
                samples = [sample.split(",")[:-1] for sample in text.split(";")[:-1]]
                check(all(len(sample) == len(series) for sample in samples), "a sample lacks values")
                times = [float(sample[0]) for sample in samples]
                check(times == sorted(set(times)), "times do not rise")
                progress.append(samples)
        self.line(r"\.")
        return {"name": name, "common": common, "runs": runs, "progress": progress}


def check_ompl(database, files):
    connection = sqlite3.connect(database)
    connection.row_factory = sqlite3.Row
    run_count = 0
    for file in files:
        log = OmplLog(pathlib.Path(file).read_text())
        check(log.name == pathlib.Path(file).stem, f"{file}: experiment {log.name}")
        trials = connection.execute("SELECT * FROM trial_table WHERE substr(map_key, 1, 8) = ? ORDER BY planner, mission_index",
                                    (log.name.rsplit("-", 1)[1],)).fetchall()
        check(log.properties["traversability_normalized_ratio"] == trials[0]["traversability_normalized_ratio"], "traversability")
        check(int(log.seed) == trials[0]["map_seed"] % 2**64, "seed")
        check(float(log.time_limit) == 20.0, f"time limit {log.time_limit}")
        runs = [(planner, run) for planner in log.planners for run in planner["runs"]]
        check(len(runs) == len(trials), f"{len(runs)} runs, {len(trials)} trials")
        for (planner, run), trial in zip(runs, trials):
            check(planner["name"] == trial["planner"].replace(" ", "_"), planner["name"])
            check(log.enums["status"][int(run["status"])] == trial["outcome"], f"status {run['status']}")
            check(run["solved"] == trial["is_finished"], f"solved {run['solved']}")
            check(run["solution_length"] == (trial["path_length_m"] if trial["is_finished"] else None), "solution_length")
            check(abs(run["time"] - 0.001 * trial["processing_time_ms"] * trial["plan_call_count"]) < 1e-12, "time")
            for name in set(run) & set(trial.keys()):
                check(run[name] == trial[name], f"{name}: {run[name]}, stored {trial[name]}")
        for planner in log.planners:
            for run, samples in zip(planner["runs"], planner["progress"]):
                check(abs(float(samples[-1][0]) - run["flight_time_s"]) < 0.011, "progress does not end with the flight")
        run_count += len(runs)
    print(f"{len(files)} experiments, {run_count} runs")


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
    elif what == "ompl":
        check_ompl(arguments[0], arguments[1:])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
