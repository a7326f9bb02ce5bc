#!/usr/bin/env python3
"""Draws how the weights fly that train.sh kept on the way, from what agile_samples --outcomes wrote.

    python success.py --plot success.png first_1of3_flights.json … agile_flights.json

Bars are Wilson's intervals of 95 %.
"""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

SUCCESS, COLLISION = "#0072B2", "#D55E00"
SUFFIX = "_flights.json"


def wilson(count: int, of: int) -> tuple[float, float]:
    """The 95 % interval of a share (Wilson 1927)."""
    z = 1.959963984540054
    share, scale = count / of, 1.0 + z * z / of
    middle = share + z * z / (2 * of)
    half = z * math.sqrt(share * (1.0 - share) / of + z * z / (4.0 * of * of))
    return (middle - half) / scale, (middle + half) / scale


def draw(flights: dict[str, dict[str, int]], picture: Path) -> None:
    """flights: outcomes by the weights' name, in the order of the training."""
    figure = Figure(figsize=(8.0, 4.0), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    places = range(len(flights))
    for outcome, colour, label in (("reached_goal", SUCCESS, "reached the goal"), ("collided", COLLISION, "collided")):
        shares, below, above = [], [], []
        for ends in flights.values():
            count, total = ends.get(outcome, 0), ends["flights"]
            low, high = wilson(count, total)
            shares.append(count / total)
            below.append(max(0.0, count / total - low))
            above.append(max(0.0, high - count / total))
        axes.errorbar(
            places,
            shares,
            yerr=[below, above],
            color=colour,
            label=label,
            marker="o",
            markersize=4,
            linewidth=1.2,
            capsize=3,
        )
    total = max(ends["flights"] for ends in flights.values())
    axes.set_title(f"{total} flights of each at 3 m/s with true depth, maps that no sample is from", fontsize=9)
    axes.set_xticks(list(places), [name.replace("_", "\n") for name in flights], fontsize=8)
    axes.set_xlabel("weights, in the order of the training", fontsize=8)
    axes.set_ylabel("share of flights", fontsize=8)
    axes.set_ylim(-0.02, 1.02)
    axes.tick_params(labelsize=8)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(picture, dpi=110, metadata={"Software": None})


def main(given: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Draws success during training.")
    parser.add_argument(
        "flights", type=Path, nargs="+", metavar="JSON", help="what agile_samples --outcomes wrote, in order"
    )
    parser.add_argument("--plot", type=Path, required=True, metavar="PNG")
    options = parser.parse_args(given)
    draw({file.name.removesuffix(SUFFIX): json.loads(file.read_text()) for file in options.flights}, options.plot)


if __name__ == "__main__":
    main()
