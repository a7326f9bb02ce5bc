#!/usr/bin/env python3
"""Flies the sweeps configs/sweeps/ci*.yaml with each program and compares them with results/baselines/ci*.csv, bit for
bit.

usage: golden.py SOURCE_FOLDER PROGRAM...

A wanted change of results: scripts/bless_golden.sh "REASON".
"""

import pathlib
import subprocess
import sys
import tempfile


def main():
    source = pathlib.Path(sys.argv[1])
    sweeps = sorted(source.glob("configs/sweeps/ci*.yaml"))
    tables = sorted(source.glob("results/baselines/ci*.csv"))
    if not sweeps or [s.stem for s in sweeps] != [t.stem for t in tables]:
        sys.exit(
            f"sweeps {[s.stem for s in sweeps]} and tables {[t.stem for t in tables]} do not match: "
            f"scripts/bless_golden.sh"
        )
    failed = False
    for program in sys.argv[2:]:
        for sweep, table in zip(sweeps, tables):
            with tempfile.TemporaryDirectory() as folder:
                database = pathlib.Path(folder, "ci.db")
                subprocess.run([program, "run", sweep, "--db", database, "--jobs", "2", "--quiet"], check=True)
                done = subprocess.run([program, "compare", table, database, "--exact"])
                failed = failed or done.returncode != 0
    if failed:
        sys.exit('Results are not those of results/baselines. If that is wanted: scripts/bless_golden.sh "REASON".')


if __name__ == "__main__":
    main()
