#!/usr/bin/env python3
"""Flies one sweep by several programs or with several numbers of workers, each into a database of its own, and compares
every deterministic value of every row, trajectories bit for bit; the digests of every generator's world, and those of
every sensor's images.

    same_bits.py SWEEP PROGRAM:JOBS PROGRAM:JOBS …

Left out are measured times, runs, and what follows from the bytes of the planners' files (another compiler makes other
files)."""

import hashlib
import pathlib
import sqlite3
import subprocess
import sys
import tempfile

MAP_COLUMNS = (
    "map_key, world_digest, obstacle_count, triangle_count, traversability, traversability_normalized_ratio, "
    "relative_gap_size, obstacle_density_1pm2, free_volume_ratio"
)


def rows(database):
    db = sqlite3.connect(database)
    metrics = [
        name for (name,) in db.execute("SELECT name FROM metric_definitions WHERE NOT is_measured ORDER BY position")
    ]
    columns = ", ".join(f"trials.{name}" for name in metrics)
    trials = db.execute(f"""SELECT label, trials.map_key, mission_index, outcome, reason, end_time_s, {columns},
                                   sample_count, samples_digest, call_count, calls_digest
                            FROM trials JOIN planners USING (planner_key) JOIN trajectories USING (trial_key)
                                 JOIN plan_calls USING (trial_key) ORDER BY 1, 2, 3""").fetchall()
    maps = db.execute(f"SELECT {MAP_COLUMNS} FROM maps ORDER BY 1").fetchall()
    missions = db.execute("SELECT * FROM missions ORDER BY map_key, mission_index").fetchall()
    db.close()
    return {"trial": trials, "map": maps, "mission": missions}


GENERATORS = [
    "forest",
    "hall",
    "avoidbench_forest",
    "avoidbench_indoor",
    "maze",
    "gap_walls",
    "dead_ends",
    "poles",
    "overhangs",
]


def world_digests(program):
    digests = []
    for generator in GENERATORS:
        table = subprocess.run(
            [program, "maps", "info", generator, "--seed", "5", "--missions", "0"],
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        digests.append((generator, table.split()[-1]))
    return digests


NOISY = [
    argument
    for setting in [
        "trials=1",
        "maps.poisson_radius_m=3.5",
        "sensor=depth_noisy",
        "sensor.delay_ms=20",
        "sensor.jitter_ms=4",
        "odometry.position_sigma_m=0.01",
        "odometry.position_drift_ratio=0.01",
        "odometry.yaw_drift_deg_per_sqrt_s=0.1",
        "odometry.delay_ms=5",
    ]
    for argument in ("--set", setting)
]
SENSORS = [
    "depth_ideal",
    "depth_noisy",
    "stereo_sgm",
    "stereo_sgbm",
    "stereo_original",
    "d435_like",
    "oak_d_like",
    "surround",
]


def image_digests(program, folder):
    """Of the sheets of every sensor: both eyes, colour, disparity, depth; and the figures beside them."""
    digests = []
    for sensor in SENSORS:
        for generator in ["hall", "forest"]:
            picture = pathlib.Path(folder) / "sheet.png"
            figures = subprocess.run(
                [program, "sensors", "show", sensor, "--map", generator, "--png", picture],
                check=True,
                capture_output=True,
                text=True,
            ).stdout
            digests.append((sensor, generator, figures, hashlib.sha256(picture.read_bytes()).hexdigest()))
    return digests


def main():
    sweep, runs = sys.argv[1], sys.argv[2:]
    found, without_workers = [], {}
    with tempfile.TemporaryDirectory() as folder:
        for number, run in enumerate(runs):
            program, _, jobs = run.rpartition(":")
            database = pathlib.Path(folder) / f"{number}.db"
            run_all = [program, "run", sweep, "--jobs", jobs, "--quiet"]
            subprocess.run(run_all + ["--db", database, "--set", "trials=1"], check=True)
            noisy = pathlib.Path(folder) / f"{number}_noisy.db"
            subprocess.run(run_all + ["--db", noisy] + NOISY, check=True)
            if program not in without_workers:
                without_workers[program] = {"world": world_digests(program), "image": image_digests(program, folder)}
            found.append(
                rows(database)
                | {f"noisy {kind}": values for kind, values in rows(noisy).items()}
                | without_workers[program]
            )
    if not found[0]["trial"]:
        sys.exit("no trials")
    different = 0
    for run, other in zip(runs[1:], found[1:]):
        for kind in found[0]:
            if len(found[0][kind]) != len(other[kind]):
                sys.exit(f"{run}: {len(other[kind])} {kind} rows, {runs[0]} has {len(found[0][kind])}")
            for one, two in zip(found[0][kind], other[kind]):
                if one != two:
                    different += 1
                    print(f"{kind} rows differ between {runs[0]} and {run}:\n  {one}\n  {two}")
    if different:
        sys.exit(f"{different} rows differ")
    print(f"{len(found[0]['trial'])} trials, the same bits in {len(runs)} runs")


if __name__ == "__main__":
    main()
