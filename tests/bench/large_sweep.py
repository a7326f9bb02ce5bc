#!/usr/bin/env python3
"""How the program stands a sweep of 100,000 trials: time and memory of `run` when everything is flown and when half is,
of `report`, and the size of the database a trial, with and without trajectories.

    tests/bench/large_sweep.py [BUILD FOLDER, build/release] [--maps COUNT] [--trials COUNT] [--folder FOLDER]

The database is filled by bench/large_sweep: real keys and specs of every trial, one real flight a planner for all. A
figure is the least of three; the folder is a temporary one, removed at the end, if not given."""

import argparse
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

SWEEP = """
sweep: large
maps: {{generator: hall, area_m: [12, 16], poisson_radius_m: {{from: 2.5, to: 5, count: 10}}, seeds: {seeds}}}
trials: {trials}
planners: [{build}/planners/straight_line.so, {build}/planners/reactive.so]
sensor: {{width_px: 80, height_px: 60}}
mission: {{time_limit_s: 30}}
"""


def measured(*command):
    """Wall time, CPU time and peak resident memory of the process itself."""
    began = time.monotonic()
    with open(os.devnull, "wb") as nothing:
        process = subprocess.Popen([str(word) for word in command], stdout=nothing, stderr=nothing)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"{command}: exit code {process.returncode}")
    return time.monotonic() - began, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def show(what, *command, repeats=3):
    wall_s, cpu_s, peak_mib = map(min, zip(*[measured(*command) for _ in range(repeats)]))
    print(f"{what:44} {wall_s:7.2f} s wall {cpu_s:7.2f} s CPU {peak_mib:7.0f} MiB peak", flush=True)


def fill(build, folder, name, maps, trials, *options):
    sweep = folder / f"{name}.yaml"
    sweep.write_text(SWEEP.format(build=build, seeds=max(1, maps // 10), trials=trials))
    database = folder / f"{name}.db"
    database.unlink(missing_ok=True)
    said = subprocess.run(
        [build / "bench/large_sweep", sweep, database, *options], check=True, capture_output=True, text=True
    ).stdout
    print(said.strip())
    count = int(said.split()[0])
    print(f"{'database, a trial':44} {database.stat().st_size / count / 1024:7.1f} KiB", flush=True)
    return sweep, database


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default="build/release", type=pathlib.Path)
    parser.add_argument("--maps", type=int, default=1000)
    parser.add_argument("--trials", type=int, default=50, help="missions a map")
    parser.add_argument("--folder", type=pathlib.Path)
    given = parser.parse_args()
    build, program = given.build.resolve(), given.build.resolve() / "avoidbench"
    folder = given.folder or pathlib.Path(tempfile.mkdtemp(prefix="avoidbench_large_"))
    try:
        sweep, database = fill(build, folder, "large", given.maps, given.trials, "--no-trajectories")
        show("config check", program, "config", "check", sweep)
        show("run, all flown", program, "run", sweep, "--quiet", "--db", database)
        show("run --dry-run", program, "run", sweep, "--dry-run", "--db", database)
        show("run --shard 3/100 --dry-run", program, "run", sweep, "--dry-run", "--shard", "3/100", "--db", database)
        show("report", program, "report", database)
        fill(build, folder, "flown", 10, 20)
    finally:
        if given.folder is None:
            shutil.rmtree(folder)


if __name__ == "__main__":
    main()
