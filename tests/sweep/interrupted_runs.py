#!/usr/bin/env python3
"""A sweep that is killed, stopped, cut into shards or short of disk gives the rows of one that was left alone.

    interrupted_runs.py PROGRAM [--kills N]

Kills `run` N times at random (seeded) moments and lets it go on each time, checking the file after every kill; stops it
by SIGTERM; flies three shards and merges them in two orders and twice; flies on after half; with 1, 2 and 4 workers; on
a full disk where a small tmpfs can be mounted. Compares every deterministic value of every row with an undisturbed
run."""

import argparse
import contextlib
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

from same_bits import rows

SWEEP = """
sweep: interrupted
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: [2.6, 3.2], seeds: 2}
trials: 3
planners: [straight_line, reactive]
sensor: {width_px: 80, height_px: 60}
mission: {time_limit_s: 20}
"""
TRIALS = 24


class Runs:
    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)
        self.sweep = self.folder / "sweep.yaml"
        self.sweep.write_text(SWEEP)
        self.problems = 0

    def command(self, name, *options):
        return [self.program, "run", str(self.sweep), "--quiet", "--db", str(self.folder / name), *options]

    def run(self, name, *options):
        subprocess.run(self.command(name, *options), check=True, stderr=subprocess.DEVNULL)
        return rows(self.folder / name)

    def fly_undisturbed(self, *options):
        """Flies what the others are compared with; how long it took, in s."""
        began = time.monotonic()
        self.whole = self.run("whole.db", *options)
        took_s = time.monotonic() - began
        if len(self.whole["trial"]) != TRIALS:
            sys.exit(f"{len(self.whole['trial'])} trials undisturbed, expected {TRIALS}")
        print(f"{TRIALS} trials undisturbed in {took_s:.1f} s", flush=True)
        return took_s

    def expect(self, what, found, expected):
        different = [kind for kind in expected if found[kind] != expected[kind]]
        print(f"{'ok' if not different else 'DIFFERENT: ' + ', '.join(different)}  {what}", flush=True)
        self.problems += 1 if different else 0

    def check_file(self, name):
        file = self.folder / name
        if not file.exists() or file.stat().st_size == 0:
            return
        with contextlib.closing(sqlite3.connect(file)) as db:
            answer = db.execute("PRAGMA integrity_check").fetchone()[0]
        if answer != "ok":
            print(f"damaged: {answer}")
            self.problems += 1


def killed(runs, kills, whole_s):
    """`run`, killed at a random moment, until it was killed so often, or a little oftener than it takes to end."""
    draws = random.Random(7)
    attempt = done = 0
    while done < kills:
        name = f"killed{attempt}.db"
        while done < kills:
            process = subprocess.Popen(runs.command(name), stderr=subprocess.DEVNULL)
            try:
                process.wait(timeout=draws.uniform(0.0, 0.3 * whole_s))
                break  # it came to its end
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
                done += 1
                runs.check_file(name)
        runs.expect(f"killed, {done} times by now, and resumed", runs.run(name), runs.whole)
        attempt += 1


def stopped(runs, whole_s):
    process = subprocess.Popen(runs.command("stopped.db"), stderr=subprocess.DEVNULL)
    time.sleep(0.4 * whole_s)
    process.send_signal(signal.SIGTERM)
    code = process.wait()
    if code not in (75, 0):
        print(f"exit code {code} after SIGTERM")
        runs.problems += 1
    runs.check_file("stopped.db")
    runs.expect("stopped by SIGTERM and resumed", runs.run("stopped.db"), runs.whole)


def sharded(runs):
    for part in (1, 2, 3):
        runs.run(f"shard{part}.db", "--shard", f"{part}/3")
    parts = [str(runs.folder / f"shard{part}.db") for part in (1, 2, 3)]
    for name, order in [("merged.db", parts), ("backward.db", parts[::-1]), ("merged.db", parts)]:
        subprocess.run(
            [runs.program, "merge", "--complete", str(runs.folder / name), *order],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        runs.expect(f"three shards merged into {name}", rows(runs.folder / name), runs.whole)


def short_of_disk(runs):
    disk = runs.folder / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1200k", "tmpfs", disk], capture_output=True).returncode != 0:
        print("passed over: a full disk (no tmpfs can be mounted here)")
        return
    try:
        found = subprocess.run(runs.command("disk/full.db"), capture_output=True, text=True)
        if found.returncode != 2 or "full" not in found.stderr:
            print(f"a full disk: exit code {found.returncode}, {found.stderr}")
            runs.problems += 1
        runs.check_file("disk/full.db")
        for file in disk.glob("full.db*"):  # the log beside it, too
            shutil.copy(file, runs.folder)
    finally:
        subprocess.run(["umount", disk], check=True)
    runs.expect("on a full disk, then elsewhere", runs.run("full.db"), runs.whole)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=200)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(given.program, folder)
        whole_s = runs.fly_undisturbed("--jobs", "1")
        for jobs in ("2", "4"):
            runs.expect(f"{jobs} workers", runs.run(f"jobs{jobs}.db", "--jobs", jobs), runs.whole)
        runs.run("half.db", "--set", "trials=1")
        runs.expect("resumed after a third", runs.run("half.db"), runs.whole)
        sharded(runs)
        stopped(runs, whole_s)
        short_of_disk(runs)
        killed(runs, given.kills, whole_s)
    sys.exit(1 if runs.problems else 0)


if __name__ == "__main__":
    main()
