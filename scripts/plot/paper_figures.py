#!/usr/bin/env python3
"""Draws the figures of the AvoidBench paper (arXiv 2301.07430, figures 6 and 7) from databases of results.

usage: paper_figures.py DB… --output FOLDER [--sweep NAME] [--program avoidbench] [--formats pdf,png] [--figures NAME,…]

Every number comes from the program: rates, means and intervals from `avoidbench report --format json`, single trials
and maps from `avoidbench export trials`. For each sweep, FOLDER/SWEEP/ gets these figures, one column (3.5 in) wide, as
PDF and PNG. The same results give the same bytes:

  speed_curve                  share of missions completed with at least a goal velocity, and v90 of each planner
  success_by_traversability    6a: success rate by group of maps, with Wilson's 95 % intervals
  contrast_factors             6b: contrast factors of pairs of planners, with their intervals
  traversability_by_gap_size   6c: each map's traversability against its relative gap size
  path_optimality, energy_optimality, goal_velocity, mission_progress, processing_time
                               7: a metric against traversability: means of maps (small) and of groups (line)
  metrics                      all of these and the success rate, two columns (7.16 in) wide

For a limit search (`avoidbench limit`) there is one figure instead:

  limit_curve                  success rate as the field changes: fitted curves with 95 % intervals, and the trials
"""

import argparse
import hashlib
import json
import pathlib
import re
import subprocess
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import pandas
except ImportError as error:
    sys.exit(
        f"figures need Python with matplotlib and pandas ({error}): apt-get install python3-matplotlib python3-pandas"
    )

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import figures  # noqa: E402
import style  # noqa: E402


def output_of(command):
    """The program's standard output. Its messages go to our stderr; if it fails, this program exits."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    except OSError as error:
        sys.exit(f"{command[0]}: {error.strerror}; name the program with --program")
    if done.returncode != 0:
        sys.exit(done.returncode)
    return done.stdout.decode("utf-8")


def read_results(arguments):
    """The report's sections and one table of all trials."""
    choice = ["--sweep", arguments.sweep] if arguments.sweep else []
    databases = [str(file) for file in arguments.databases]
    report = output_of(
        [arguments.program, "report", *databases, *choice, "--format", "json", "--metrics", ",".join(figures.REPORTED)]
    )
    trials = output_of([arguments.program, "export", "trials", *databases, *choice, "--format", "jsonl"])
    return json.loads(report), pandas.DataFrame([json.loads(line) for line in trials.split("\n") if line])


def with_report_labels(trials):
    """The trials with the report's planner names: if two share a label, the start of their key is added."""
    key_count = trials.groupby("planner")["planner_key"].transform("nunique")
    is_shared = key_count > 1
    trials = trials.copy()
    trials.loc[is_shared, "planner"] = trials["planner"] + "@" + trials["planner_key"].str[:6]
    return trials


def safe_file_name(text):
    """A folder name from a sweep's name: never a path, hidden, or an option. The same as safe_file_name in
    lib/base/base/output_file.hpp."""
    name = re.sub(r"^[.-]", "_", re.sub(r"[^A-Za-z0-9_.-]", "_", text))
    if name == text and 0 < len(name) <= 100:
        return name
    return name[:80] + "-" + hashlib.sha256(text.encode("utf-8")).hexdigest()[:8]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("databases", nargs="+", type=pathlib.Path, metavar="DB")
    parser.add_argument("--output", required=True, type=pathlib.Path, metavar="FOLDER")
    parser.add_argument(
        "--sweep", default="", help="only this sweep; NAME@2 for its revision 2 (default: all, the latest revisions)"
    )
    parser.add_argument("--program", default="avoidbench", help="the avoidbench program (default: from PATH)")
    parser.add_argument("--formats", default="pdf,png", help="pdf, png or svg, separated by commas (default: pdf,png)")
    parser.add_argument("--figures", default=",".join(figures.names()), help="only these, separated by commas")
    arguments = parser.parse_args()
    wanted = arguments.figures.split(",")
    unknown = sorted(set(wanted) - set(figures.names()))
    if unknown:
        parser.error(f"no figure {unknown[0]}; there are: {', '.join(figures.names())}")

    sections, trials = read_results(arguments)
    style.apply()
    names = [section["sweep"] for section in sections]
    for section in sections:
        if names.count(section["sweep"]) > 1:
            sys.exit(f"these databases hold different sweeps under the name {section['sweep']!a}: draw them one by one")
        of_sweep = with_report_labels(trials[trials["sweep"] == section["sweep"]])
        folder = arguments.output / safe_file_name(section["sweep"])
        folder.mkdir(parents=True, exist_ok=True)
        count = 0
        for name, figure in figures.draw(section, of_sweep, wanted):
            count += 1
            for extension in arguments.formats.split(","):
                style.save(figure, folder / f"{name}.{extension}")
            matplotlib.pyplot.close(figure)
        print(f"drew {count} figure{'' if count == 1 else 's'} in {folder}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
