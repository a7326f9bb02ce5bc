#!/usr/bin/env python3
"""What a planner that misbehaves in every way costs the others: wall time of a sweep with and without it, and whether
the others' flights stay the same.

    tests/bench/torture_time.py [BUILD FOLDER, build/release] [--rounds 1] [--trials 32] [--jobs 2] [--plan-timeout 10]

The torture planner (tests/sweep/planners/torture.cpp) misbehaves as the mission's seed decides: crashes, exits,
exceptions, endless loops, memory, stack, closed descriptors, NaN, threads. A hang costs a whole plan timeout of one
worker. Fails where a trial lacks its row or a good flight differs. Rounds of the two sweeps alternate; on a machine
that others use the ratio says little."""

import argparse
import collections
import pathlib
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import time

SWEEP = """
sweep: torture
seed: 5
maps: {{generator: forest, area_m: [40, 40], poisson_radius_m: 4, seeds: [1]}}
trials: {trials}
planners: [{planners}]
sensor: depth_ideal
"""
GOOD = ["reactive", "ego", "mbplanner"]


def fly(build, folder, name, planners, given):
    sweep, database = folder / f"{name}.yaml", folder / f"{name}.db"
    sweep.write_text(SWEEP.format(trials=given.trials, planners=", ".join(str(planner) for planner in planners)))
    database.unlink(missing_ok=True)
    command = [
        build / "avoidbench",
        "run",
        sweep,
        "--quiet",
        "--jobs",
        str(given.jobs),
        "--plan-timeout",
        str(given.plan_timeout),
        "--memory-limit",
        "800",
        "--db",
        database,
    ]
    began = time.monotonic()
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    return time.monotonic() - began, database


def trials_of(database):
    """By planner and mission: outcome, reason, end time, path length, digest of the flight."""
    query = """SELECT planner, mission_index, outcome, reason, end_time_s, path_length_m, samples_digest
               FROM trial_table LEFT JOIN trajectories USING (trial_key)"""
    with sqlite3.connect(f"file:{database}?mode=ro", uri=True) as connection:
        return {(row[0], row[1]): row[2:] for row in connection.execute(query)}


def check(without, with_it, given):
    good = {key: row for key, row in with_it.items() if key[0] in GOOD}
    if good != without:
        sys.exit("FAILED: the others' flights differ")
    bad = [row for key, row in with_it.items() if key[0] == "torture"]
    missions = {mission for _, mission in without}
    if len(without) != len(GOOD) * len(missions) or len(bad) != len(missions):
        sys.exit(f"FAILED: {len(without)} and {len(bad)} rows of {len(missions)} missions")
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default="build/release", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--trials", type=int, default=32)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--plan-timeout", type=float, default=10.0)
    given = parser.parse_args()
    build = given.build.resolve()
    torture = build / "tests/sweep/torture.so"
    ratios = []
    with tempfile.TemporaryDirectory() as name:
        for _ in range(given.rounds):
            alone_s, alone = fly(build, pathlib.Path(name), "without", GOOD, given)
            with_s, both = fly(build, pathlib.Path(name), "with", [*GOOD, torture], given)
            bad = check(trials_of(alone), trials_of(both), given)
            ratios.append(with_s / alone_s)
            print(
                f"{len(bad) * len(GOOD)} good trials {alone_s:6.1f} s; with {len(bad)} of the torture planner "
                f"{with_s:6.1f} s: "
                f"{ratios[-1]:.2f} times",
                flush=True,
            )
    print(
        f"median {statistics.median(ratios):.2f} times ({min(ratios):.2f} to {max(ratios):.2f}); every trial has its "
        f"row, the good flights are the same"
    )
    for reason, count in collections.Counter(f"{row[0]}: {row[1][:60]}" for row in bad).most_common():
        print(f"  {count:3}  {reason}")


if __name__ == "__main__":
    main()
