#!/usr/bin/env python3
"""A run goes on flying while the terminal that shows its progress is stopped, as by Ctrl-S: all trials are stored before it goes on.

    stopped_terminal.py PROGRAM"""
import contextlib
import os
import pathlib
import pty
import select
import sqlite3
import subprocess
import sys
import tempfile
import termios
import time

TRIALS = 12
SWEEP = f"""
sweep: stopped
maps: {{generator: hall, area_m: [10, 14], poisson_radius_m: 2.6, seeds: [1]}}
trials: {TRIALS}
planners: [straight_line]
sensor: {{width_px: 80, height_px: 60}}
mission: {{time_limit_s: 20}}
"""
WAIT_S = 60.0


def stored(file):
    with contextlib.suppress(sqlite3.Error), contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as db:
        return db.execute("SELECT count(*) FROM trials").fetchone()[0]
    return 0


def shown_until(control, wanted, process):
    """What the terminal shows until the words come, or until the run has ended."""
    shown = b""
    end = time.monotonic() + WAIT_S
    while wanted not in shown and time.monotonic() < end:
        if select.select([control], [], [], 0.05)[0]:
            shown += os.read(control, 4096)
        elif process.poll() is not None:
            break
    return shown


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "sweep.yaml").write_text(SWEEP)
        control, terminal = pty.openpty()
        process = subprocess.Popen([program, "run", "sweep.yaml", "--db", "results.db", "--jobs", "1"], cwd=folder, stdin=terminal,
                                   stdout=terminal, stderr=terminal)
        first = shown_until(control, b"trials", process)
        termios.tcflow(terminal, termios.TCOOFF)
        before = stored(folder / "results.db")
        end = time.monotonic() + WAIT_S
        while stored(folder / "results.db") < TRIALS and process.poll() is None and time.monotonic() < end:
            time.sleep(0.1)
        after = stored(folder / "results.db")
        termios.tcflow(terminal, termios.TCOON)
        last = shown_until(control, b"results are in", process)
        code = process.wait(WAIT_S)
    if before == TRIALS:
        sys.exit(f"all was flown before the terminal stopped: {first!r}")
    if after != TRIALS or code != 0 or b"results are in" not in last:
        sys.exit(f"{before} trials when it stopped, {after} of {TRIALS} before it went on, exit code {code}: {last!r}")
    print(f"{before} trials when the terminal stopped, {after} before it went on")


if __name__ == "__main__":
    main()
