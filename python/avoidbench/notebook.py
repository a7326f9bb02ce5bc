"""Results as notebooks show them."""

from __future__ import annotations

import html
import math
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

_LEFT, _RIGHT = ' style="text-align:left"', ' style="text-align:right"'


def _cell(text: str, tag: str = "td", is_left: bool = False) -> str:
    return f"<{tag}{_LEFT if is_left else _RIGHT}>{html.escape(text)}</{tag}>"


def _number(value: float | None) -> str:
    if value is None or math.isnan(value):
        return "–"
    return f"{value:.3g}" if abs(value) < 1000 or math.isinf(value) else f"{value:.0f}"


def _rate(row: Mapping[str, Any]) -> str:
    rate, lower, upper = (row[name] for name in ("success_rate", "success_rate_lower", "success_rate_upper"))
    if rate is None:
        return "–"
    interval = "" if lower is None or upper is None else f" [{lower:.2f}, {upper:.2f}]"
    return f"{rate:.2f}{interval}"


def _planner_table(rows: Sequence[Mapping[str, Any]], units: Mapping[str, str]) -> str:
    means = [name for name in (rows[0] if rows else {}) if name in units and f"{name}_count" in rows[0]]
    heads = [_cell("planner", "th", True)]
    heads += [_cell(name, "th") for name in ("trials", "reached goal", "success rate [95 %]")]
    heads += [_cell(name + (f", {units[name]}" if units[name] else ""), "th") for name in means]
    lines = ["<tr>" + "".join(heads) + "</tr>"]
    for row in rows:
        cells = [
            _cell(str(row["planner"]), is_left=True),
            _cell(str(row["trial_count"])),
            _cell(str(row["finished_count"])),
            _cell(_rate(row)),
        ]
        cells += [_cell(_number(row[name])) for name in means]
        lines.append("<tr>" + "".join(cells) + "</tr>")
    return "<table>" + "".join(lines) + "</table>"


def summary_html(
    path: str, sweeps: Sequence[Mapping[str, Any]], metrics: pd.DataFrame | None, problem: str = ""
) -> str:
    """A table by planner for each sweep of the program's report.

    Args:
        path: of the database, as it was given.
        sweeps: what `avoidbench report --format json` says.
        metrics: definitions, for units.
        problem: why there is no report; "" where there is one.
    """
    units = {} if metrics is None else dict(zip(metrics["name"], metrics["unit"]))
    parts = [f"<p><b>{html.escape(path)}</b></p>"]
    if problem:
        parts.append(f"<p>{html.escape(problem)}</p>")
    for sweep in sweeps:
        parts.append(f"<p>{html.escape(str(sweep['title']))}</p>")
        parts += [f"<p>Warning: {html.escape(str(warning))}</p>" for warning in sweep["warnings"]]
        parts.append(_planner_table(sweep["tables"].get("planners", []), units))
    return "<div>" + "".join(parts) + "</div>"
