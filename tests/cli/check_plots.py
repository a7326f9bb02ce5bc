#!/usr/bin/env python3
"""Flies a tiny sweep and draws its figures, whatever its planners are called: all are there, are pictures of the right
size, and drawn again have the same bytes.

usage: check_plots.py --program build/avoidbench
"""

import argparse
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

SWEEP = """
sweep: tiny
planners: [{plugin: straight_line, label: "$\\\\frac{1}{$"}, {plugin: reactive, label: _reactive}]
trials: 1
maps: {generator: hall, area_m: [10, 12], poisson_radius_m: [2.5, 3, 3.5, 4, 5]}
sensor: {width_px: 80, height_px: 60}
mission: {time_limit_s: 10}
"""
COLUMN_IN, PAGE_IN, DOTS_PER_IN = 3.5, 7.16, 300
FIGURES = {
    "speed_curve": COLUMN_IN,
    "success_by_traversability": COLUMN_IN,
    "contrast_factors": COLUMN_IN,
    "traversability_by_gap_size": COLUMN_IN,
    "path_optimality": COLUMN_IN,
    "energy_optimality": COLUMN_IN,
    "goal_velocity": COLUMN_IN,
    "mission_progress": COLUMN_IN,
    "processing_time": COLUMN_IN,
    "metrics": PAGE_IN,
}
TWICE = ["speed_curve", "success_by_traversability", "processing_time"]


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def python():
    """A Python with matplotlib, as the program looks for one."""
    for candidate in (os.environ.get("AVOIDBENCH_PYTHON"), "python3", "/usr/bin/python3"):
        if (
            candidate
            and subprocess.run([candidate, "-c", "import matplotlib, pandas"], capture_output=True).returncode == 0
        ):
            return candidate
    sys.exit("no Python with matplotlib and pandas: apt-get install python3-matplotlib python3-pandas")


def check_figures(folder, figures=FIGURES):
    expected = {f"{name}.{kind}" for name in figures for kind in ("pdf", "png")}
    found = {file.name for file in folder.iterdir()}
    if found != expected:
        sys.exit(f"{folder}: lacks {sorted(expected - found)}, has {sorted(found - expected)} too")
    for name, width_in in figures.items():
        png = (folder / f"{name}.png").read_bytes()
        width = struct.unpack(">I", png[16:20])[0]
        if png[:8] != b"\x89PNG\r\n\x1a\n" or abs(width - width_in * DOTS_PER_IN) > 1 or len(png) < 8000:
            sys.exit(f"{name}.png: {len(png)} bytes, {width} pixels wide")
        pdf = (folder / f"{name}.pdf").read_bytes()
        if not pdf.startswith(b"%PDF-") or len(pdf) < 5000 or b"/CreationDate" in pdf:
            sys.exit(f"{name}.pdf: {len(pdf)} bytes, or with a date")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    program = os.path.abspath(parser.parse_args().program)
    with tempfile.TemporaryDirectory(prefix="avoidbench_plots_") as name:
        folder = pathlib.Path(name)
        (folder / "tiny.yaml").write_text(SWEEP)
        run([program, "run", "tiny.yaml", "--quiet"], cwd=folder)
        run([program, "report", "results/tiny.db", "--output", "report.txt", "--plots", "first"], cwd=folder)
        check_figures(folder / "first" / "tiny")
        script = pathlib.Path(program).parent / "share/avoidbench/scripts/plot/paper_figures.py"
        run(
            [
                python(),
                "-W",
                "error:::__main__",  # of pandas, about how it is called
                str(script),
                "results/tiny.db",
                "--output",
                "second",
                "--program",
                program,
                "--figures",
                ",".join(TWICE),
            ],
            cwd=folder,
        )
        again = sorted((folder / "second" / "tiny").iterdir())
        if len(again) != 2 * len(TWICE):
            sys.exit(f"drawn again: {[file.name for file in again]}")
        for file in again:
            if file.read_bytes() != (folder / "first" / "tiny" / file.name).read_bytes():
                sys.exit(f"{file.name} differs from one time to the next")

        # One that looks for a limit has a figure of its own.
        run(
            [
                program,
                "limit",
                "tiny.yaml",
                "--over",
                "max_speed_mps=1..5",
                "--max-trials",
                "18",
                "--quiet",
                "--db",
                "limit.db",
            ],
            cwd=folder,
        )
        run([program, "report", "limit.db", "--output", "report.txt", "--plots", "first"], cwd=folder)
        check_figures(folder / "first" / "tiny_limit_max_speed_mps", {"limit_curve": COLUMN_IN})

        # A sweep's name in a database of somebody else's may be a path: its figures stay in the folder.
        (folder / "foreign").write_text(f"#!/bin/sh\n'{program}' \"$@\" | sed 's|\\btiny\\b|../../escaped|g'\n")
        (folder / "foreign").chmod(0o755)
        run(
            [
                python(),
                str(script),
                "results/tiny.db",
                "--output",
                "deep/third",
                "--program",
                str(folder / "foreign"),
                "--figures",
                "success_by_traversability",
            ],
            cwd=folder,
        )
        made = [made.name for made in (folder / "deep" / "third").iterdir()]
        if len(made) != 1 or not made[0].startswith("_._.._escaped-") or (folder / "escaped").exists():
            sys.exit(f"figures of the sweep ../../escaped are in {made}")

        # Without matplotlib it says what is missing.
        bare = dict(os.environ, AVOIDBENCH_PYTHON="/bin/false")
        done = subprocess.run(
            [program, "report", "results/tiny.db", "--output", "report.txt", "--plots", "third"],
            cwd=folder,
            env=bare,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 2 or "apt-get install python3-matplotlib python3-pandas" not in done.stderr:
            sys.exit(f"without matplotlib: exit code {done.returncode}, {done.stderr}")
    print(f"{len(FIGURES)} figures; {len(TWICE)} drawn again are the same")
    return 0


if __name__ == "__main__":
    sys.exit(main())
