"""Computes custom metrics: `avoidbench report --metrics-from mine.py` runs this.

usage: custom_metrics.py FILE.py DATABASE.db

Each public function of FILE.py is a metric. It takes one flight and returns a number, or None if the metric is not
defined. The first line of its docstring describes it: "Turns per metre [1/m]; less is better".

A flight has these attributes. Arrays have n samples in order of time, in the world frame (ENU, z up) if not named
otherwise. n is 0 if the planner crashed before it flew.

  trial                     dict: the trial's row of the view trial_table (outcome, planner, end_time_s, all metrics, …)
  time_s                    (n,)    simulated
  position_world_m          (n, 3)
  velocity_world_mps        (n, 3)
  acceleration_world_mps2   (n, 3)
  q_world_body              (n, 4)  w x y z
  rates_body_radps          (n, 3)
  reference_world_m         (n, 3)  commanded position; NaN where there was none
  clearance_m               (n,)    between body and the nearest surface
  rotor_power_w             (n,)
  calls                     list of dicts, one per planner call: time_s, cpu_time_s, wall_time_s, status, command_kind
"""

import functools
import importlib.util
import inspect
import json
import math
import pathlib
import sqlite3
import sys
import traceback
import zlib

import numpy

# Values of a sample in the table trajectories: name, first and last column (schema.sql).
COLUMNS = {
    "time_s": (0, 0),
    "position_world_m": (1, 3),
    "velocity_world_mps": (4, 6),
    "acceleration_world_mps2": (7, 9),
    "q_world_body": (10, 13),
    "rates_body_radps": (14, 16),
    "reference_world_m": (17, 19),
    "clearance_m": (20, 20),
    "rotor_power_w": (21, 21),
}
WIDTH = 22
CALL_COLUMNS = ("time_s", "cpu_time_s", "wall_time_s", "status", "command_kind", "latency_s")


class Flight:
    """One stored trial. Data is read from the database on first use."""

    def __init__(self, trial, database):
        self.trial = trial
        self._database = database

    @functools.cached_property
    def _samples(self):
        row = self._database.execute(
            "SELECT sample_count, samples FROM trajectories WHERE trial_key = ?", (self.trial["trial_key"],)
        ).fetchone()
        if row is None:
            return numpy.empty((0, WIDTH))
        count, samples = row
        planes = numpy.frombuffer(zlib.decompress(samples), "u1").reshape(WIDTH, 8, count)
        return planes.transpose(2, 0, 1).copy().view("<f8")[..., 0]

    def __getattr__(self, name):
        if name not in COLUMNS:
            raise AttributeError(f"a flight has no {name}; it has trial, calls, {', '.join(COLUMNS)}")
        first, last = COLUMNS[name]
        return self._samples[:, first] if first == last else self._samples[:, first : last + 1]

    @functools.cached_property
    def calls(self):
        row = self._database.execute(
            "SELECT calls_json FROM plan_calls WHERE trial_key = ?", (self.trial["trial_key"],)
        ).fetchone()
        return [dict(zip(CALL_COLUMNS, call)) for call in json.loads(row[0])] if row else []


def metrics_of(file):
    """The public functions of a file, in its order."""
    spec = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(file.resolve().parent))
    spec.loader.exec_module(module)
    found = [
        function
        for name, function in vars(module).items()
        if inspect.isfunction(function) and function.__module__ == module.__name__ and not name.startswith("_")
    ]
    if not found:
        raise SystemExit(f"{file}: expected a public function for each metric, found none")
    for function in found:
        if len(inspect.signature(function).parameters) != 1:
            raise SystemExit(
                f"{file}:{function.__code__.co_firstlineno}: {function.__name__} must take one argument, the flight"
            )
    return found


def value_of(function, flight, file):
    """The metric of one flight; None for NaN and infinity, which JSON lacks."""
    try:
        value = function(flight)
        value = None if value is None else float(value)
    except Exception:  # show any error to the user, with the trial that caused it
        traceback.print_exc()
        raise SystemExit(f"{file}: {function.__name__} failed in trial {flight.trial['trial_key'][:12]}") from None
    return None if value is None or not math.isfinite(value) else value


def trial_rows(database):
    """Each trial once, with the columns of trial_table that the database itself has."""
    database.row_factory = sqlite3.Row
    rows = {row["trial_key"]: dict(row) for row in database.execute("SELECT * FROM trial_table ORDER BY trial_key")}
    database.row_factory = None
    return rows.values()


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    file = pathlib.Path(sys.argv[1])
    functions = metrics_of(file)
    database = sqlite3.connect(f"{pathlib.Path(sys.argv[2]).resolve().as_uri()}?mode=ro", uri=True)
    values = {}
    for trial in trial_rows(database):
        flight = Flight(trial, database)
        values[trial["trial_key"]] = [value_of(function, flight, file) for function in functions]
    metrics = [
        {"name": function.__name__, "doc": (inspect.getdoc(function) or "").split("\n")[0]} for function in functions
    ]
    json.dump({"metrics": metrics, "values": values}, sys.stdout)


if __name__ == "__main__":
    main()
