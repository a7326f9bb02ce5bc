#!/usr/bin/env python3
"""Compares two databases of 100000 trials each and fails where that takes more than 12 s of processor time or 500 MB:
the digests of half a gigabyte a database are half of it.

usage: compare_large.py PROGRAM [TRIALS]

One flown trial is copied to TRIALS / 4 missions of 4 planners with other keys, outcomes and figures: the rows are as
long as real ones."""

import hashlib
import os
import pathlib
import random
import resource
import sqlite3
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
from redigest import digested, hex_of  # noqa: E402

MISSIONS_A_MAP = 25
PLANNERS = 4
SWEEP = """sweep: large
planners: [straight_line]
trials: 1
maps: {generator: hall, poisson_radius_m: 5, area_m: [12, 15]}
mission: {time_limit_s: 1}
"""


def key(*parts):
    return hashlib.sha256(repr(parts).encode()).hexdigest()


def copies_of(connection, table):
    """The one row of a table, by column, and a function that inserts a changed copy."""
    cursor = connection.execute(f"SELECT * FROM {table}")
    names = [column[0] for column in cursor.description]
    row = dict(zip(names, cursor.fetchone()))
    sql = f"INSERT INTO {table} ({', '.join(names)}) VALUES ({', '.join('?' * len(names))})"
    return lambda **changes: connection.execute(sql, [{**row, **changes}[name] for name in names])


def write_digests(connection):
    """Of the rows as they are stored: a whole number in a column of reals has become one."""
    cursor = connection.execute("SELECT * FROM trials")
    names = [column[0] for column in cursor.description]
    covered = sorted(set(names) - {"attempt", "run_id", "row_digest"})
    rows = (dict(zip(names, values)) for values in cursor)
    digests = [(hex_of(digested(covered, [row[name] for name in covered])), row["trial_key"]) for row in rows]
    connection.executemany("UPDATE trials SET row_digest = ? WHERE trial_key = ?", digests)


def grow(path, trial_count, seed):
    """Adds maps, missions, planners and trials to a database that has one trial."""
    luck = random.Random(seed)
    connection = sqlite3.connect(path)
    add = {
        table: copies_of(connection, table)
        for table in ("planners", "maps", "missions", "sweep_missions", "trials", "sweep_trials")
    }
    planners = [key("planner", i) for i in range(PLANNERS)]
    labels = [f"planner_{i}" for i in range(PLANNERS)]
    # A planner's key is the digest of its columns, which the program makes anew: so it is told by the program's own
    # rule.
    for i in range(PLANNERS):
        label, name, version, file_digest, json, privileged = labels[i], "p", "1", key("file", i), "{}", 0
        digest = hashlib.sha256()
        for text in (label, name, version, file_digest, json):
            digest.update(len(text).to_bytes(8, "little") + text.encode())
        digest.update(privileged.to_bytes(8, "little"))
        planners[i] = digest.hexdigest()
        add["planners"](
            planner_key=planners[i],
            label=label,
            name=name,
            version=version,
            file_digest=file_digest,
            parameters_json=json,
            is_privileged=privileged,
        )
    for mission in range(trial_count // PLANNERS):
        map_number, index = divmod(mission, MISSIONS_A_MAP)
        map_key = key("map", map_number)
        if index == 0:
            add["maps"](map_key=map_key, map_seed=map_number + 10, world_digest=key("world", map_number))
        add["missions"](map_key=map_key, mission_index=index, start_x_m=0.1 * index)
        add["sweep_missions"](map_key=map_key, mission_index=index)
        for planner in planners:
            is_finished = luck.random() < 0.8
            trial = key("trial", planner, map_key, index)
            add["trials"](
                trial_key=trial,
                map_key=map_key,
                mission_index=index,
                planner_key=planner,
                outcome="reached_goal" if is_finished else "collided",
                finished=int(is_finished),
                path_optimality_pct=luck.uniform(1, 9) if is_finished else None,
                energy_optimality=luck.uniform(10, 90) if is_finished else None,
                average_goal_velocity_mps=luck.uniform(1, 3) if is_finished else None,
                mission_progress_pct=100 if is_finished else luck.uniform(0, 90),
                min_clearance_m=luck.uniform(0, 1),
            )
            add["sweep_trials"](trial_key=trial)
    flown = connection.execute("SELECT row_digest FROM trials ORDER BY rowid").fetchone()
    write_digests(connection)
    if connection.execute("SELECT row_digest FROM trials ORDER BY rowid").fetchone() != flown:
        sys.exit("row_digest is not the program's any more")
    connection.commit()
    connection.close()


def main():
    program = os.path.abspath(sys.argv[1])
    trial_count = int(sys.argv[2]) if len(sys.argv) > 2 else 100000
    with tempfile.TemporaryDirectory() as folder:
        sweep = pathlib.Path(folder, "large.yaml")
        sweep.write_text(SWEEP)
        databases = [pathlib.Path(folder, name) for name in ("base.db", "new.db")]
        for seed, database in enumerate(databases):
            subprocess.run(
                [program, "run", sweep, "--db", database, "--jobs", "1", "--quiet"],
                check=True,
                stderr=subprocess.DEVNULL,
            )
            grow(database, trial_count, seed)
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        before = usage.ru_utime + usage.ru_stime
        start = time.monotonic()
        done = subprocess.run([program, "compare", *databases], stdout=subprocess.PIPE, text=True)
        wall_s = time.monotonic() - start
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu_s = usage.ru_utime + usage.ru_stime - before
        peak_mb = usage.ru_maxrss / 1024
        size_mb = databases[0].stat().st_size / 1e6
    print(done.stdout)
    print(
        f"2 x {trial_count} trials (files of {size_mb:.0f} MB): {wall_s:.2f} s, {cpu_s:.2f} s of the processor, "
        f"{peak_mb:.0f} MB"
    )
    if done.returncode not in (0, 1) or cpu_s > 12 or peak_mb > 500:
        sys.exit(f"exit code {done.returncode}, or more than 12 s or 500 MB")


if __name__ == "__main__":
    main()
