"""Tables of a database as DataFrames."""

from __future__ import annotations

import json
import re
import sqlite3
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from avoidbench.database_file import ResultsError, SweepChoice
from avoidbench.digests import check_trials

_TEXTS = frozenset(
    (
        "sweep",
        "planner",
        "generator",
        "outcome",
        "reason",
        "cause",
        "planner_name",
        "planner_version",
        "program_version",
        "git_hash",
        "map_key",
        "planner_key",
        "trial_key",
        "world_digest",
        "spec_json",
        "invalid_reason",
    )
)
_COUNTS = frozenset(
    (
        "revision",
        "mission_index",
        "attempt",
        "trial_id",
        "obstacle_count",
        "triangle_count",
        "trial_count",
        "mission_count",
    )
)
_FLAGS = frozenset(("is_finished", "is_privileged", "is_valid", "is_latest"))


def _axes_of(path: Path, specs: Collection[str]) -> list[str]:
    """What these sweeps vary, by path: their axes, and the parameters to which they give a planner several values."""
    axes: list[str] = []
    for text in specs:
        try:
            spec = json.loads(text)
            axes += [axis["path"] for axis in spec.get("axes", [])]
            first: dict[tuple[str, str], Any] = {}
            for planner in spec.get("planners", []):
                for parameter in planner.get("parameters", []):
                    name = parameter["name"]
                    if first.setdefault((planner["plugin"], name), parameter) != parameter:
                        axes.append(f"planner.{name}")
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise ResultsError(f"{path}: damaged: table sweeps: spec_json is not the spec of a sweep") from error
    return list(dict.fromkeys(axes))


def _is_axis(name: str) -> bool:
    """Whether a column of the trials is what a sweep varies: it is called by its path. Other names than those of paths,
    which a file of anybody's may have, are none."""
    return name == "seed" or bool(re.fullmatch(r"\w+(\.\w+)+", name, re.ASCII) and len(name) <= _MOST_LETTERS)


def _map_value(spec: Any, path: str) -> Any:
    """What a map's spec says at a path of trials; a list is its text, as in the table of trials."""
    for part in path.split(".")[1:]:
        if isinstance(spec, list) and part.isdecimal() and int(part) < len(spec):
            spec = spec[int(part)]
        else:
            spec = spec.get(part) if isinstance(spec, dict) else None
    return json.dumps(spec, separators=(",", ":")) if isinstance(spec, (list, dict)) else spec


def _value_column(cells: Sequence[Any]) -> pd.Series[Any]:
    """Numbers where all values are numbers, NaN for none."""
    values = [cell for cell in cells if cell is not None]
    if not all(isinstance(cell, (int, float)) for cell in values):
        return pd.Series(cells, dtype=object)
    is_whole = len(values) == len(cells) and all(type(cell) is int for cell in values)
    return pd.Series(cells, dtype=np.int64 if is_whole else np.float64)


def frame_of(rows: Sequence[Mapping[str, Any]], names: Sequence[str]) -> pd.DataFrame:
    """Rows of the database with these columns; a column that an older file lacks is NaN."""
    columns: dict[str, pd.Series[Any]] = {}
    for name in names:
        cells = [row.get(name) for row in rows]
        if _is_axis(name):
            columns[name] = _value_column(cells)
        elif name == "map_seed":  # stored as the same bits with a sign
            columns[name] = pd.Series([cell % 2**64 for cell in cells if cell is not None], dtype=np.uint64)
        elif name in _TEXTS:
            columns[name] = pd.Series(["" if cell is None else cell for cell in cells], dtype=object)
        elif name in _COUNTS:
            columns[name] = pd.Series(cells, dtype=np.int64)
        elif name in _FLAGS:
            columns[name] = pd.Series(cells, dtype=bool)
        else:
            columns[name] = pd.Series(cells, dtype=np.float64)
    return pd.DataFrame(columns)


def report_frame(rows: Sequence[Mapping[str, Any]]) -> pd.DataFrame:
    """Rows of a table of the program's JSON; null is NaN."""
    frame = pd.DataFrame(list(rows))
    for name in frame.columns:
        if frame[name].isna().all():
            frame[name] = frame[name].astype(np.float64)
    return frame


def _rows(connection: sqlite3.Connection, query: str, values: Sequence[Any]) -> list[dict[str, Any]]:
    cursor = connection.execute(query, values)
    names = [column[0] for column in cursor.description]
    return [dict(zip(names, row)) for row in cursor]


MAP_COLUMNS = (
    "generator",
    "map_seed",
    "obstacle_count",
    "triangle_count",
    "traversability",
    "traversability_normalized_ratio",
    "relative_gap_size",
    "obstacle_density_1pm2",
    "free_volume_ratio",
    "world_digest",
    "map_key",
    "spec_json",
)
MISSION_COLUMNS = (
    "sweep",
    "revision",
    "generator",
    "map_seed",
    "mission_index",
    "start_x_m",
    "start_y_m",
    "start_z_m",
    "goal_x_m",
    "goal_y_m",
    "goal_z_m",
    "start_yaw_rad",
    "reference_length_m",
    "traversability_obstruction",
    "view_occlusion",
    "angle_over_length_1pm",
    "is_valid",
    "invalid_reason",
    "map_key",
)
_FROM_FILES = ("mesh", "point_cloud")  # no fields of obstacles
_MOST_AXES, _MOST_LETTERS = 200, 200  # that the program shows

# As the view trial_table of lib/bench/store/views.sql. That of the file is its own, and not trusted.
_TRIALS = """
SELECT s.sweep, s.revision, p.label AS planner, m.generator, m.map_seed{axes},
       m.traversability, m.traversability_normalized_ratio, m.relative_gap_size,
       CASE WHEN m.generator IN ('mesh', 'point_cloud') THEN NULL ELSE m.obstacle_density_1pm2 END
         AS obstacle_density_1pm2,
       t.mission_index, i.start_x_m, i.start_y_m, i.start_z_m, i.goal_x_m, i.goal_y_m, i.goal_z_m,
       i.reference_length_m, i.traversability_obstruction, i.view_occlusion, i.angle_over_length_1pm,
       t.outcome, t.outcome = 'reached_goal' AS is_finished, t.reason,
       (SELECT e.cause FROM explanations e WHERE e.trial_key = t.trial_key) AS cause, t.end_time_s{metrics},
       p.name AS planner_name, p.version AS planner_version, p.is_privileged, r.program_version, r.git_hash,
       t.attempt, t.map_key, t.planner_key, t.rowid AS trial_id, t.trial_key
FROM sweep_trials s
JOIN trials t USING (trial_key)
JOIN planners p USING (planner_key)
JOIN maps m ON m.map_key = t.map_key
JOIN missions i ON i.map_key = t.map_key AND i.mission_index = t.mission_index
JOIN runs r USING (run_id)
WHERE {condition}
ORDER BY s.sweep, s.revision, p.label, t.planner_key, t.map_key, t.mission_index, t.trial_key"""


def _in_sweeps(choices: Sequence[SweepChoice]) -> tuple[str, list[Any]]:
    if not choices:
        return "0", []
    places = ", ".join("(?, ?)" for _ in choices)
    return f"(s.sweep, s.revision) IN (VALUES {places})", [value for choice in choices for value in choice]


def _specs(connection: sqlite3.Connection, choices: Sequence[SweepChoice]) -> list[str]:
    condition, values = _in_sweeps(choices)
    return [row[0] for row in connection.execute(f"SELECT s.spec_json FROM sweeps s WHERE {condition}", values)]


def _axis_query(axis: str) -> tuple[str, str]:
    """SQL for the value of an axis, of a trial t on a map m, and its parameter."""
    prefix = next((prefix for prefix in ("planner.filter.", "planner.") if axis.startswith(prefix)), "")
    name = axis.removeprefix(prefix)
    if prefix and name not in ("label", "plugin", "file_digest"):
        return (
            "(SELECT CASE WHEN json_extract(value, '$.is_text') THEN json_extract(value, '$.text') "
            "ELSE json_extract(value, '$.number') END "
            f"FROM json_each(t.spec_json, '$.{prefix}parameters') WHERE json_extract(value, '$.name') = ?)"
        ), name
    of_map = axis.startswith("map.")
    parts = axis.removeprefix("map.").split(".")
    path = "".join(f"[{part}]" if part.isdecimal() else f'."{part}"' for part in parts)
    return f"json_extract({'m' if of_map else 't'}.spec_json, ?)", f"${path}"


def read_trials(connection: sqlite3.Connection, path: Path, choices: Sequence[SweepChoice]) -> pd.DataFrame:
    """The trials of these sweeps, a row each, as the program exports them.

    Raises:
        ResultsError: a trial of the file is not what was stored.
    """
    check_trials(connection, path)
    condition, values = _in_sweeps(choices)
    axes = [axis for axis in _axes_of(path, _specs(connection, choices)) if _is_axis(axis)][:_MOST_AXES]
    queries = [_axis_query(axis) for axis in axes]
    metrics = [row[0] for row in connection.execute("SELECT name FROM metric_definitions ORDER BY position")]
    query = _TRIALS.format(
        axes="".join(f', {sql} AS "{axis}"' for axis, (sql, _) in zip(axes, queries)),
        metrics="".join(f""", t."{name.replace('"', '""')}\"""" for name in metrics),
        condition=condition,
    )
    cursor = connection.execute(query, [*(parameter for _, parameter in queries), *values])
    names = [column[0] for column in cursor.description]
    rows = [dict(zip(names, row)) for row in cursor]
    if all(row["generator"] in _FROM_FILES for row in rows):  # no fields of obstacles
        names = [name for name in names if name not in ("relative_gap_size", "obstacle_density_1pm2")]
    return frame_of(rows, names)


def read_maps(connection: sqlite3.Connection, path: Path, choices: Sequence[SweepChoice]) -> pd.DataFrame:
    """The maps of these sweeps, a row each with MAP_COLUMNS and what the sweeps vary of them."""
    condition, values = _in_sweeps(choices)
    rows = _rows(
        connection,
        f"SELECT * FROM maps WHERE map_key IN (SELECT s.map_key FROM sweep_missions s WHERE {condition})",
        values,
    )
    for row in rows:
        if row["generator"] in _FROM_FILES:
            row["obstacle_density_1pm2"] = None
    rows.sort(key=lambda row: (row["generator"], row["map_seed"] % 2**64, row["map_key"]))
    frame = frame_of(rows, MAP_COLUMNS)
    map_specs = [json.loads(row["spec_json"]) for row in rows]
    for axis in _axes_of(path, _specs(connection, choices)):
        if axis.startswith("map."):
            frame[axis] = _value_column([_map_value(spec, axis) for spec in map_specs])
    return frame


def read_missions(connection: sqlite3.Connection, choices: Sequence[SweepChoice]) -> pd.DataFrame:
    """The missions of these sweeps, a row each with MISSION_COLUMNS."""
    condition, values = _in_sweeps(choices)
    rows = _rows(
        connection,
        "SELECT i.*, s.sweep, s.revision, m.generator, m.map_seed FROM "
        "sweep_missions s JOIN missions i USING (map_key, mission_index) JOIN maps m ON "
        f"m.map_key = s.map_key WHERE {condition} ORDER BY s.sweep, s.revision, s.map_key, "
        "s.mission_index",
        values,
    )
    return frame_of(rows, MISSION_COLUMNS)


def read_sweeps(connection: sqlite3.Connection) -> pd.DataFrame:
    """Every revision of every sweep."""
    rows = _rows(
        connection,
        """
        SELECT s.sweep, s.revision, s.spec_json,
               s.revision = (SELECT max(o.revision) FROM sweeps o WHERE o.sweep = s.sweep) AS is_latest,
               (SELECT count(*) FROM sweep_trials t WHERE t.sweep = s.sweep AND t.revision = s.revision)
                 AS trial_count,
               (SELECT count(*) FROM sweep_missions i WHERE i.sweep = s.sweep AND i.revision = s.revision)
                 AS mission_count
        FROM sweeps s ORDER BY s.sweep, s.revision""",
        (),
    )
    return frame_of(rows, ("sweep", "revision", "is_latest", "trial_count", "mission_count", "spec_json"))


def read_metrics(connection: sqlite3.Connection) -> pd.DataFrame:
    """The definitions of the metrics that the file holds, in the order of reports."""
    rows = _rows(
        connection,
        "SELECT name, unit, better, population, version, is_measured, doc, formula, "
        "source FROM metric_definitions ORDER BY position",
        (),
    )
    frame = pd.DataFrame(
        rows, columns=["name", "unit", "better", "population", "version", "is_measured", "doc", "formula", "source"]
    )
    return frame.astype({"version": np.int64, "is_measured": bool})
