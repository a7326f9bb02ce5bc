#!/usr/bin/env python3
"""Flights of `explain --what-if` that are killed or stopped go on where they were; the smallest scene is flown by
`run`.

    killed_flights.py PROGRAM

Kills `explain` at seeded moments, looks at the file after each, stops it once by SIGINT, and compares the rows with
those of an undisturbed call with one worker. Then finds the smallest scene of a collision and flies what was
written."""

import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

SWEEP = """
sweep: killed
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: 2.6, seeds: 2}
trials: 3
planners: [straight_line, reactive]
sensor: {width_px: 80, height_px: 60}
wind: {mean_world_mps: [2, 0, 0]}
mission: {time_limit_s: 20}
"""
KILLS = 4


def expect(is_right, what):
    print(f"{'ok' if is_right else 'WRONG'}  {what}", flush=True)
    if not is_right:
        sys.exit(1)


def rows_of(file):
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as database:
        return database.execute("SELECT * FROM what_ifs ORDER BY trial_key, change").fetchall()


def rows(file):
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as database:
        expect(database.execute("PRAGMA integrity_check").fetchone() == ("ok",), f"{file.name} is whole")
    return rows_of(file)


def explain(program, file, *options):
    return [program, "explain", str(file), "--what-if", "nothing,no_latency,no_wind,slower", "--control", "2", *options]


def kill_often(program, file, whole):
    random.seed(1)
    seen = 0
    for _ in range(KILLS):
        if seen == len(whole):  # a quick machine: all were flown before the last kills
            break
        process = subprocess.Popen(
            explain(program, file, "--jobs", "2"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        # Once it has more than the one before: else a slow machine would see no flight at all.
        while process.poll() is None and len(rows_of(file)) <= seen:
            time.sleep(0.05)
        time.sleep(random.uniform(0.0, 0.2))
        process.kill()
        process.wait()
        now = rows(file)
        expect(len(now) > seen and set(now) <= set(whole), f"killed with {len(now)} of {len(whole)} rows")
        seen = len(now)
    return seen


def stop_once(program, file):
    process = subprocess.Popen(
        explain(program, file, "--jobs", "2"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    line = process.stderr.readline()
    while "flights" not in line and line:
        line = process.stderr.readline()
    process.send_signal(signal.SIGINT)
    process.communicate()
    expect(process.returncode in (0, 130), f"interrupted: exit code {process.returncode}")


def smallest_scene(program, folder, file):
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as database:
        key, reason = database.execute(
            "SELECT trial_key, reason FROM trials WHERE outcome = 'collided' ORDER BY trial_key"
        ).fetchone()
    scene = folder / "scene"
    texts = [
        subprocess.run(
            [program, "explain", str(file), key, "--minimal", str(scene), "--jobs", jobs],
            check=True,
            text=True,
            capture_output=True,
        ).stdout
        for jobs in ("1", "2")
    ]
    expect(texts[0] == texts[1], "the same scene for any number of workers:\n" + texts[0])
    expect(texts[0].startswith("obstacles  1 of "), "one obstacle is left")
    expect(sorted(path.name for path in scene.iterdir()) == ["map.glb", "sweep.yaml"], "nothing else is left behind")
    subprocess.run(
        [program, "run", str(scene / "sweep.yaml"), "--db", str(folder / "scene.db"), "--quiet"],
        check=True,
        stderr=subprocess.DEVNULL,
    )
    with sqlite3.connect(folder / "scene.db") as database:
        flown = database.execute("SELECT outcome, reason FROM trials ORDER BY mission_index DESC").fetchone()
    expect(
        f"flight     {flown[0]}: {flown[1]}\n" in texts[0], f"run flies the same: {flown}; the trial itself: {reason}"
    )


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "sweep.yaml").write_text(SWEEP)
        whole, killed = folder / "whole.db", folder / "killed.db"
        subprocess.run(
            [program, "run", str(folder / "sweep.yaml"), "--db", str(whole), "--quiet"],
            check=True,
            stderr=subprocess.DEVNULL,
        )
        shutil.copy(whole, killed)
        told = subprocess.run(explain(program, whole, "--jobs", "1"), check=True, text=True, capture_output=True).stdout
        expected = rows(whole)
        expect(len(expected) > 10, f"{len(expected)} rows undisturbed")
        kill_often(program, killed, expected)
        stop_once(program, killed)
        again = subprocess.run(
            explain(program, killed, "--jobs", "2"), check=True, text=True, capture_output=True
        ).stdout
        expect(rows(killed) == expected, "the same rows")
        expect(again.replace("What if, killed", "What if, whole") == told, "the same tables")
        killed.chmod(0o444)
        once_more = subprocess.run(explain(program, killed), check=True, text=True, capture_output=True)
        expect(
            once_more.stdout == again and "to fly" not in once_more.stderr, "all is there: nothing is flown or written"
        )
        smallest_scene(program, folder, whole)


if __name__ == "__main__":
    main()
