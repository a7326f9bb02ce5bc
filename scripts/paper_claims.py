#!/usr/bin/env python3
"""paper_claims.py DB[:MISSIONS]…: AvoidBench's claims about its planners, held against databases of the paper's sweeps.

With MISSIONS only the first of each map count: an unfinished sweep has more trials of some maps than of others.

Prints the Markdown tables of docs/results.md. Each number is from `avoidbench report`, with its 95 % interval. The
verdict follows from the interval alone: `yes` where all of it agrees with the claim, `no` where none of it does, `?`
between. AVOIDBENCH: the program (default: avoidbench)."""

import json
import math
import os
import subprocess
import sys

WORLDS = {
    "paper_outdoor": "outdoor, stereo",
    "paper_indoor": "indoor, stereo",
    "paper_outdoor_depth": "outdoor, true depth",
    "paper_indoor_depth": "indoor, true depth",
}
RIVALS = ("ego", "mbplanner", "agile")


def report(database):
    program = os.environ.get("AVOIDBENCH", "avoidbench")
    database, _, missions = database.partition(":")
    command = [program, "report", database, "--format", "json"]
    if missions:
        command += ["--where", f"mission_index < {missions}"]
    return json.loads(subprocess.run(command, capture_output=True, check=True).stdout)[0]


def by(rows, **wanted):
    return next(row for row in rows if all(row[name] == value for name, value in wanted.items()))


def ends(row, name):
    """A number of a row with the ends of its interval, NaN where the report has none: that compares as not known."""
    return tuple(math.nan if row[key] is None else row[key] for key in (name, name + "_lower", name + "_upper"))


def shown(value, lower, upper, digits=2):
    value, lower, upper = ("–" if math.isnan(number) else f"{number:.{digits}f}" for number in (value, lower, upper))
    return value if lower == upper == "–" else f"{value} [{lower}, {upper}]"


def above(number, bound):
    """Whether a number with its interval is above a bound: yes, no or ?."""
    _, lower, upper = number
    return "yes" if lower > bound else "no" if upper < bound else "?"


def joined(verdicts):
    return "no" if "no" in verdicts else "?" if "?" in verdicts else "yes"


def rises(tables):
    """Success rises with traversability, for each planner."""
    numbers = [ends(by(tables["difficulty"], planner=name), "success_spearman") for name in RIVALS]
    text = "; ".join(f"{name} {shown(*number)}" for name, number in zip(RIVALS, numbers))
    return text, joined([above(number, 0.0) for number in numbers])


def contrast(tables, first, second):
    """Failures per metre of the first over those of the second, smoothed, with its interval."""
    for row in tables["pairs"]:
        number = ends(row, "contrast_factor_smoothed")
        if (row["planner"], row["other_planner"]) == (first, second):
            return number
        if (row["planner"], row["other_planner"]) == (second, first):
            return 1 / number[0], 1 / number[2], 1 / number[1]
    raise SystemExit(f"paper_claims.py: no pair {first}, {second}")


def equally_safe(tables):
    """Within a factor of two is as safe. Where neither fails, the interval says nothing."""
    rows = [by(tables["planners"], planner=name) for name in ("ego", "mbplanner")]
    if all(row["finished_count"] == row["trial_count"] for row in rows):
        return "neither fails", "?"
    value, lower, upper = contrast(tables, "ego", "mbplanner")
    verdict = "yes" if 0.5 <= lower and upper <= 2 else "no" if lower > 1 or upper < 1 else "?"
    return shown(value, lower, upper), verdict


def safer_than_agile(tables):
    numbers = {name: contrast(tables, "agile", name) for name in ("ego", "mbplanner")}
    text = "; ".join(f"agile / {name} {shown(*number)}" for name, number in numbers.items())
    return text, joined([above(number, 1.0) for number in numbers.values()])


def extreme(metric, planner, is_greatest, digits):
    """One planner's mean is the greatest, or the least, of the three."""

    def judged(tables):
        numbers = {name: ends(by(tables["planners"], planner=name), metric) for name in RIVALS}
        verdicts = []
        for name, (_, lower, upper) in numbers.items():
            if name == planner:
                continue
            _, own_lower, own_upper = numbers[planner]
            is_above, is_below = own_lower > upper, own_upper < lower
            verdicts.append("?" if not (is_above or is_below) else "yes" if is_above == is_greatest else "no")
        text = "; ".join(f"{name} {shown(*number, digits)}" for name, number in numbers.items())
        return text, joined(verdicts)

    return judged


def gap_size(tables):
    number = ends(by(tables["environment"], measure="relative_gap_size"), "spearman")
    return shown(*number), above(number, 0.0)


CLAIMS = [
    ("Success rises with traversability (Spearman's ρ over maps)", rises),
    ("EGO-Planner and MBPlanner are equally safe (contrast factor near 1)", equally_safe),
    ("Both are safer than Agile-Autonomy (contrast factor above 1)", safer_than_agile),
    ("Agile-Autonomy flies fastest (goal velocity, m/s)", extreme("average_goal_velocity_mps", "agile", True, 2)),
    ("Agile-Autonomy has the best path optimality (excess, %)", extreme("path_optimality_pct", "agile", False, 1)),
    ("Agile-Autonomy has the best energy optimality (m/s²)", extreme("energy_optimality", "agile", False, 0)),
    ("EGO-Planner's mission progress is the highest (%)", extreme("mission_progress_pct", "ego", True, 1)),
    ("MBPlanner computes longest (CPU time of a call, ms)", extreme("processing_time_ms", "mbplanner", True, 2)),
    ("Traversability grows with the relative gap size (Spearman's ρ over maps)", gap_size),
]


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    reports = {}
    for database in sys.argv[1:]:
        found = report(database)
        reports[WORLDS[found["sweep"]]] = found["tables"]
    worlds = [world for world in WORLDS.values() if world in reports]
    print("| | " + " | ".join(worlds) + " |\n|---|" + "---|" * len(worlds))
    print(
        "| flights of each planner | "
        + " | ".join(str(reports[w]["planners"][0]["trial_count"]) for w in worlds)
        + " |"
    )
    for planner in [row["planner"] for row in reports[worlds[0]]["planners"]]:
        rates = []
        for world in worlds:
            row = by(reports[world]["planners"], planner=planner)
            rates.append(
                f"{row['finished_count']}/{row['trial_count']} " + shown(*ends(row, "success_rate")).partition(" ")[2]
            )
        print(f"| {planner} | " + " | ".join(rates) + " |")
    print("\n| claim | " + " | ".join(worlds) + " |\n|---|" + "---|" * len(worlds))
    for claim, judged in CLAIMS:
        cells = [judged(reports[world]) for world in worlds]
        print(f"| {claim} | " + " | ".join(f"**{verdict}**: {text}" for text, verdict in cells) + " |")


if __name__ == "__main__":
    main()
