"""The figures. Each is a function of a report section and the sweep's trials."""

import dataclasses

import numpy
import style
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator

TRAVERSABILITY = "traversability_normalized_ratio"
TRAVERSABILITY_LABEL = "normalised traversability"


@dataclasses.dataclass(frozen=True)
class Metric:
    name: str  # column of the report
    column: str  # of the trials
    file: str  # of its figure; "" without a separate figure
    label: str  # of its axis


METRICS = [
    Metric("path_optimality_pct", "path_optimality_pct", "path_optimality", "path optimality (%)"),
    Metric("energy_optimality", "energy_optimality", "energy_optimality", "energy optimality (m/s²)"),
    Metric("average_goal_velocity_mps", "average_goal_velocity_mps", "goal_velocity", "goal velocity (m/s)"),
    Metric("mission_progress_pct", "mission_progress_pct", "mission_progress", "mission progress (%)"),
    Metric("processing_time_ms", "processing_time_ms", "processing_time", "processing time (ms)"),
    Metric("success_rate", "is_finished", "", "success rate"),
]
REPORTED = [
    metric.name for metric in METRICS if metric.name != "success_rate"
]  # to be asked for; rates are always there


def names():
    return [
        "speed_curve",
        "success_by_traversability",
        "contrast_factors",
        "traversability_by_gap_size",
        *(metric.file for metric in METRICS if metric.file),
        "metrics",
        "limit_curve",
    ]


def draw(section, trials, wanted):
    """Yields (file name, figure) of those `wanted` that the sweep has: groups and pairs need two maps, two planners."""
    tables = section["tables"]
    if tables.get("limits"):
        # Its trials are at other values for each planner: rates and means over all are meaningless.
        if "limit_curve" in wanted:
            yield "limit_curve", limit_curve(section)
        return
    planners = [row["planner"] for row in tables["planners"]]
    if "speed_curve" in wanted and any(row["goal_velocity_mps"] > 0 for row in tables["speed_curve"]):
        yield "speed_curve", speed_curve(tables["speed_curve"], tables["speed"], planners)
    groups = tables.get("groups", [])
    maps = trials.drop_duplicates("map_key")
    if "success_by_traversability" in wanted and groups:
        yield "success_by_traversability", success_by_group(groups, planners)
    if "contrast_factors" in wanted and tables.get("pairs"):
        yield "contrast_factors", contrast_factors(tables["pairs"])
    if "traversability_by_gap_size" in wanted and maps["relative_gap_size"].notna().any():
        yield "traversability_by_gap_size", traversability_by_gap(maps)
    if not maps[TRAVERSABILITY].notna().any():
        return
    for metric in METRICS:
        if metric.file in wanted:
            figure, axes = style.column_figure(2.3, planners)
            metric_by_traversability(axes, metric, groups, trials, planners)
            style.planner_legend(axes, planners, style.COLUMN_IN)
            yield metric.file, figure
    if "metrics" in wanted:
        figure, panels = style.page_figure(2, 3, 4.2)
        for i, (axes, metric) in enumerate(zip(panels.flat, METRICS)):
            metric_by_traversability(axes, metric, groups, trials, planners)
            axes.set_title(f"({'abcdef'[i]})", loc="left", fontsize=style.FONT_PT)
        style.planner_legend(figure, planners, style.PAGE_IN)
        yield "metrics", figure


def speed_curve(curve, speeds, planners):
    """S(v): the share of missions completed with at least a goal velocity, and where each reaches nine of ten."""
    figure, axes = style.column_figure(2.4, planners)
    v90 = {row["planner"]: row["v90_mps"] for row in speeds}
    for planner in planners:
        look = style.looks(planners)[planner]
        rows = [row for row in curve if row["planner"] == planner]
        # S holds from the step before up to its speed, and is 0 beyond the last.
        x = [row["goal_velocity_mps"] for row in rows] + [rows[-1]["goal_velocity_mps"]]
        share, lower, upper = ([row["reached_share" + end] for row in rows] + [0.0] for end in ("", "_lower", "_upper"))
        axes.step(x, share, where="pre", color=look["color"], linestyle=look["linestyle"], zorder=3)
        axes.fill_between(x, lower, upper, step="pre", color=look["color"], alpha=0.1, linewidth=0, zorder=1)
        if v90[planner]:
            axes.plot(v90[planner], 0.9, marker=look["marker"], color=look["color"], zorder=4)
    axes.axhline(0.9, color=style.GREY, linewidth=0.7, linestyle=(0, (4, 3)))
    axes.set_xlim(left=0)
    axes.set_ylim(0, 1)
    axes.set_xlabel("goal velocity v (m/s)")
    axes.set_ylabel("S(v), share of missions")
    style.planner_legend(axes, planners, style.COLUMN_IN)
    return figure


def group_bounds(groups):
    """Least and greatest traversability of each group, from hard to easy."""
    return sorted({(row["lowest_" + TRAVERSABILITY], row["highest_" + TRAVERSABILITY]) for row in groups})


def rows_of(groups, planner):
    """The planner's rows with the place of their group."""
    places = {bounds: i for i, bounds in enumerate(group_bounds(groups))}
    rows = [
        (places[row["lowest_" + TRAVERSABILITY], row["highest_" + TRAVERSABILITY]], row)
        for row in groups
        if row["planner"] == planner
    ]
    return sorted(rows, key=lambda pair: pair[0])


def success_by_group(groups, planners):
    """6a: the rate of each planner in each group, side by side, with its interval."""
    figure, axes = style.column_figure(2.4, planners)
    bounds = group_bounds(groups)
    spread = min(0.16, 0.64 / len(planners))  # between the planners of a group; 1 between groups
    for i, planner in enumerate(planners):
        rows = [(place, row) for place, row in rows_of(groups, planner) if row["success_rate"] is not None]
        if not rows:
            continue
        x = [place + spread * (i - 0.5 * (len(planners) - 1)) for place, _ in rows]
        rate = numpy.array([row["success_rate"] for _, row in rows])
        lower = numpy.array([row["success_rate_lower"] for _, row in rows])
        upper = numpy.array([row["success_rate_upper"] for _, row in rows])
        look = style.looks(planners)[planner]
        # An interval holds its rate; rounding may put it a hair outside.
        axes.errorbar(
            x,
            rate,
            yerr=[numpy.maximum(0, rate - lower), numpy.maximum(0, upper - rate)],
            fmt=look["marker"],
            color=look["color"],
            elinewidth=0.9,
            capsize=1.5,
            capthick=0.9,
            clip_on=False,
            zorder=3,
        )
    for place in range(1, len(bounds)):
        axes.axvline(place - 0.5, color="#DDDDDD", linewidth=0.5)
    axes.set_xticks(range(len(bounds)), [f"{low:.2f}–{high:.2f}" for low, high in bounds])
    axes.tick_params(axis="x", length=0)
    axes.set_xlim(-0.5, len(bounds) - 0.5)
    axes.set_ylim(0, 1)
    axes.set_xlabel(TRAVERSABILITY_LABEL + " of the maps")
    axes.set_ylabel("success rate")
    style.planner_legend(axes, planners, style.COLUMN_IN, has_lines=False)
    return figure


def plain_number(value, _=None):
    return f"{value:g}"


def log_ticks(axis, low, high):
    """Marks at 1, 2, 5 × 10ⁿ, written out; fewer for a wide range."""
    decades = numpy.log10(high / low)
    steps = (1, 2, 5) if decades < 1.7 else (1, 3) if decades < 2.6 else (1,)
    first, last = int(numpy.floor(numpy.log10(low))) - 1, int(numpy.ceil(numpy.log10(high))) + 1
    axis.set_major_locator(FixedLocator([step * 10.0**n for n in range(first, last + 1) for step in steps]))
    axis.set_major_formatter(FuncFormatter(plain_number))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


def pair_label(row):
    first, second = style.shown(row["planner"]), style.shown(row["other_planner"])
    return f"{first} / {second}" if len(first) + len(second) <= 26 else f"{first} /\n{second}"


def contrast_factors(pairs):
    """6b: each pair's factor: filled the smoothed one with its interval, hollow the plain one where it is defined."""
    known = [row for row in pairs if row["contrast_factor_smoothed"] is not None]
    labels = [pair_label(row) for row in known]
    line_count = sum(label.count("\n") + 1 for label in labels)
    figure, axes = style.column_figure(0.75 + 0.12 * (len(known) + line_count))
    values = []
    for i, row in enumerate(known):
        y = len(known) - 1 - i
        middle = row["contrast_factor_smoothed"]
        lower, upper = row["contrast_factor_smoothed_lower"], row["contrast_factor_smoothed_upper"]
        if lower is not None and upper is not None:
            axes.plot([lower, upper], [y, y], color=style.GREY, linewidth=1.0, zorder=2, marker="|", markersize=4)
            values += [lower, upper]
        axes.plot([middle], [y], "o", color="#0072B2", zorder=4, label="smoothed, 95 % interval" if i == 0 else None)
        values.append(middle)
    plain = [
        (len(known) - 1 - i, row["contrast_factor"])
        for i, row in enumerate(known)
        if row["contrast_factor"] is not None and row["contrast_factor"] > 0
    ]
    if plain:
        axes.plot(
            [value for _, value in plain],
            [y for y, _ in plain],
            "D",
            markerfacecolor="none",
            color="#D55E00",
            markersize=5.5,
            markeredgewidth=0.9,
            zorder=3,
            label="as defined",
        )
        values += [value for _, value in plain]
    values = [value for value in values if value > 0] + [1.0]
    low, high = min(0.4, min(values) / 1.25), max(2.5, max(values) * 1.25)
    axes.axvline(1.0, color="black", linewidth=0.7)
    axes.set_xscale("log")
    axes.set_xlim(low, high)
    log_ticks(axes.xaxis, low, high)
    axes.grid(False, axis="y")
    axes.grid(True, axis="x")
    axes.set_ylim(-0.6, len(known) - 0.4)
    axes.set_yticks(range(len(known)), labels[::-1])
    axes.tick_params(axis="y", length=0)
    figure.supxlabel("contrast factor (below 1: the first planner fails less)", fontsize=style.FONT_PT)
    axes.legend(loc="lower right", ncol=2, bbox_to_anchor=(1.0, 1.01), handlelength=1.0)
    return figure


def limit_curve(section):
    """Success as a field changes: each planner's fitted curve with its interval, its trials, and its limit below."""
    limits, curve = section["tables"]["limits"], section["tables"]["limit_curve"]
    planners = [row["planner"] for row in limits]
    figure, axes = style.column_figure(2.6, planners)
    values = sorted({row["value"] for row in curve})
    field, unit = limits[0]["field"].split(".", 1)[-1], section["columns"]["value"]["unit"]
    for planner in planners:
        look = style.looks(planners)[planner]
        rows = sorted((row for row in curve if row["planner"] == planner), key=lambda row: row["value"])
        x = [row["value"] for row in rows]
        axes.plot(x, [row["fitted_rate"] for row in rows], color=look["color"], linestyle=look["linestyle"], zorder=3)
        axes.fill_between(
            x,
            [row["fitted_rate_lower"] for row in rows],
            [row["fitted_rate_upper"] for row in rows],
            color=look["color"],
            alpha=0.12,
            linewidth=0,
            zorder=1,
        )
        flown = [row for row in rows if row["trial_count"] > 0]
        axes.scatter(
            [row["value"] for row in flown],
            [row["finished_count"] / row["trial_count"] for row in flown],
            s=[min(40.0, 2.0 + 1.5 * row["trial_count"]) for row in flown],
            marker=look["marker"],
            color=look["color"],
            alpha=0.45,
            linewidths=0,
            clip_on=False,
            zorder=2,
        )
    axes.axhline(limits[0]["wanted_rate"], color=style.GREY, linewidth=0.7, linestyle=(0, (4, 3)))
    axes.set_xlim(values[0], values[-1])
    axes.set_ylim(0, 1)
    axes.set_xlabel(style.literal(field) + (f" ({unit})" if unit else ""))
    axes.set_ylabel("success rate")
    style.planner_legend(axes, planners, style.COLUMN_IN)
    return figure


def traversability_by_gap(maps):
    """6c: each map by its relative gap size and traversability."""
    figure, axes = style.column_figure(2.3)
    generators = sorted(maps["generator"].unique())
    look = style.looks(generators)
    for name in generators:
        of_kind = maps[maps["generator"] == name].dropna(subset=["relative_gap_size", TRAVERSABILITY])
        axes.plot(
            of_kind["relative_gap_size"],
            of_kind[TRAVERSABILITY],
            linestyle="none",
            marker=look[name]["marker"],
            color=look[name]["color"],
            label=name,
        )
    axes.set_xlabel("relative gap size")
    axes.set_ylabel(TRAVERSABILITY_LABEL)
    axes.set_xlim(left=0)
    axes.set_ylim(0, 1)
    if len(generators) > 1:
        style.planner_legend(axes, generators, style.COLUMN_IN, has_lines=False)
    return figure


def metric_by_traversability(axes, metric, groups, trials, planners):
    """7: each map's mean as a small mark, and the report's means of the groups of maps as a line."""
    drawn = []
    for planner in planners:
        look = style.looks(planners)[planner]
        own = trials[trials["planner"] == planner].dropna(subset=[metric.column, TRAVERSABILITY])
        by_map = own.groupby("map_key").agg({TRAVERSABILITY: "first", metric.column: "mean"})
        axes.plot(
            by_map[TRAVERSABILITY],
            by_map[metric.column],
            linestyle="none",
            marker=look["marker"],
            markersize=2.8,
            color=look["color"],
            alpha=0.5,
            markeredgewidth=0,
            zorder=2,
        )
        drawn.append(by_map[metric.column].to_numpy())
        x, y = [], []
        for _, row in rows_of(groups, planner):
            of_group = trials[
                trials[TRAVERSABILITY].between(row["lowest_" + TRAVERSABILITY], row["highest_" + TRAVERSABILITY])
            ]
            if row[metric.name] is None:
                continue
            x.append(of_group.drop_duplicates("map_key")[TRAVERSABILITY].mean())
            y.append(row[metric.name])
        axes.plot(x, y, zorder=3, **look)
    values = numpy.concatenate(drawn)
    if values.size == 0:
        axes.text(
            0.5,
            0.5,
            "not defined in any trial",
            ha="center",
            va="center",
            transform=axes.transAxes,
            fontsize=style.SMALL_PT,
        )
    elif values.min() > 0 and values.max() > 30 * values.min():
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        log_ticks(axes.yaxis, low, high)
    elif metric.name == "success_rate":
        axes.set_ylim(-0.04, 1.04)  # whole marks at 0 and 1
    elif values.min() >= 0:
        axes.set_ylim(bottom=0)
    axes.set_xlabel(TRAVERSABILITY_LABEL)
    axes.set_ylabel(metric.label)
