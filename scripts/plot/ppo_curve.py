#!/usr/bin/env python3
"""ppo_curve.py FOLDER PICTURE: draws the learning curve of python/examples/ppo.py, from its files curve.csv and
evaluation.json in FOLDER."""

import csv
import json
import pathlib
import sys

import style

MEAN_OF = 8  # updates


def main():
    folder, picture = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    with open(folder / "curve.csv", newline="") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    found = json.loads((folder / "evaluation.json").read_text())

    style.apply()
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(style.PAGE_IN * 0.8, 2.8))
    thousands = [row["steps"] / 1000 for row in rows]
    axes.plot(
        thousands,
        [row["success_rate"] for row in rows],
        ".",
        color="#BBBBBB",
        markersize=3,
        label="training: flights of one update",
    )
    means = []
    for last in range(MEAN_OF, len(rows) + 1):
        part = rows[last - MEAN_OF : last]
        means.append(sum(row["success_rate"] * row["episodes"] for row in part) / sum(row["episodes"] for row in part))
    axes.plot(thousands[MEAN_OF - 1 :], means, color="#0072B2", label=f"training: mean of {MEAN_OF} updates")

    at_end = thousands[-1] * 1.06
    for name, label, colour, marker in (
        ("ppo", "trained policy", "#009E73", "o"),
        ("straight_line", "straight_line", "#D55E00", "s"),
    ):
        rate, lower, upper = (found[name][key] for key in ("success_rate", "lower", "upper"))
        axes.errorbar(
            [at_end],
            [rate],
            yerr=[[max(0.0, rate - lower)], [max(0.0, upper - rate)]],
            fmt=marker,
            color=colour,
            capsize=3,
            label=f"held-out maps: {label}, {found[name]['reached']} of {found['missions']}, 95 %",
        )
    axes.axhline(found["straight_line"]["success_rate"], color="#D55E00", linewidth=0.6, linestyle=":")
    axes.set(
        xlabel=f"steps of all flights, thousands ({rows[-1]['wall_s'] / 60:.0f} min in all)",
        ylabel="share of flights that reach the goal",
        xlim=(0, thousands[-1] * 1.12),
        ylim=(-0.03, 1.03),
    )
    axes.legend(loc="lower right", bbox_to_anchor=(0.98, 0.02))
    figure.savefig(picture, dpi=150, metadata={"Software": None})


if __name__ == "__main__":
    main()
