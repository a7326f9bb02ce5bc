"""Reads results with pandas: rates with the program's intervals, metrics by map, and a picture of flown paths.

    python results_to_pandas.py                       # flies the built-in sweep "quick" first, in a minute
    python results_to_pandas.py results/mine.db --picture paths.png

The picture takes matplotlib; all else pandas.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import avoidbench


def print_tables(results: avoidbench.Results) -> None:
    """Success rates as the report has them, and means that pandas makes of the trials."""
    rates = results.table("planners")
    print(
        rates[
            ["sweep", "planner", "trial_count", "success_rate", "success_rate_lower", "success_rate_upper"]
        ].to_string(index=False),
        "\n",
    )
    trials = results.trials
    by_map = trials.groupby(["planner", "traversability_normalized_ratio"])
    print(by_map[["is_finished", "path_optimality_pct", "min_clearance_m"]].mean(), "\n")
    closest = trials[trials["is_finished"]].nsmallest(3, "min_clearance_m")
    print("The closest shaves of flights that reached the goal:")
    print(closest[["trial_id", "planner", "min_clearance_m", "reason"]].to_string(index=False))


def draw_paths(results: avoidbench.Results, file: Path) -> None:
    """The paths over the map with the most trials, from above; a cross where one ended in a collision."""
    from matplotlib.figure import Figure

    trials = results.trials
    map_key = trials["map_key"].value_counts().index[0]
    trials = trials[trials["map_key"] == map_key]
    figure = Figure(figsize=(6, 6))
    axes = figure.add_subplot(xlabel="x, m", ylabel="y, m", aspect="equal")
    for number, (planner, flights) in enumerate(trials.groupby("planner")):
        for place, flight in enumerate(flights.itertuples()):
            path = results.trajectory(str(flight.trial_key))
            label = str(planner) if place == 0 else None
            axes.plot(path["x_m"], path["y_m"], color=f"C{number}", linewidth=1, label=label)
            if flight.outcome == "collided" and not path.empty:
                axes.plot(path["x_m"].iloc[-1], path["y_m"].iloc[-1], "x", color=f"C{number}")
    axes.legend()
    figure.savefig(file, dpi=150)
    print(f"wrote {file}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("database", nargs="?", type=Path, help="default: the built-in sweep quick is flown")
    parser.add_argument("--picture", type=Path, help="file for a picture of the paths")
    arguments = parser.parse_args()
    results = avoidbench.read(arguments.database) if arguments.database else avoidbench.run("quick")
    print(results, "\n")
    print_tables(results)
    if arguments.picture:
        draw_paths(results, arguments.picture)


if __name__ == "__main__":
    main()
