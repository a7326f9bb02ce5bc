"""Tables of a database as DataFrames: what the program exports, and what it stores of maps."""

from __future__ import annotations

import csv
import io
import json
import math
import re
import sqlite3
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from avoidbench.database_file import SweepChoice

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
_NUMBER = re.compile(r"\+?-?((\d+\.?\d*|\.\d+)(e[+-]?\d+)?|inf|infinity|nan)", re.IGNORECASE)


def text_of_csv_field(field: str) -> str:
    """A field without the apostrophe that the program puts before what a spreadsheet would run."""
    word = field.lstrip("'")
    is_marked = field.startswith("'") and word[:1] in tuple("=+-@\t\r") and not _NUMBER.fullmatch(word)
    return field[1:] if is_marked else field


def _is_axis(name: str) -> bool:
    """Whether a column of the trials is what a sweep varies: it is called by its path."""
    return "." in name or name == "seed"


def _axis_column(cells: Sequence[str], is_text: bool) -> pd.Series[Any]:
    """What a sweep varies: numbers where all its values are numbers."""
    if is_text or not all(_NUMBER.fullmatch(cell) for cell in cells if cell):
        return pd.Series([text_of_csv_field(cell) for cell in cells], dtype=object)
    if all(re.fullmatch(r"-?\d{1,18}", cell) for cell in cells):
        return pd.Series([int(cell) for cell in cells], dtype=np.int64)
    return pd.Series([float(cell) if cell else math.nan for cell in cells], dtype=np.float64)


def trials_of_csv(data: bytes, text_axes: Collection[str]) -> pd.DataFrame:
    """The trials that `avoidbench export trials --format csv` wrote, to the last bit.

    Args:
        data: the program's output.
        text_axes: what the sweep varies whose values are no numbers.
    """
    rows = list(csv.reader(io.StringIO(data.decode("utf-8"), newline=""), strict=True))
    names, cells = rows[0], list(zip(*rows[1:])) or [()] * len(rows[0])
    columns: dict[str, pd.Series[Any]] = {}
    for name, column in zip(names, cells):
        if _is_axis(name):
            columns[name] = _axis_column(column, name in text_axes)
        elif name == "map_seed":
            columns[name] = pd.Series([int(cell) for cell in column], dtype=np.uint64)
        elif name in _TEXTS:
            columns[name] = pd.Series([text_of_csv_field(cell) for cell in column], dtype=object)
        elif name in _COUNTS:
            columns[name] = pd.Series([int(cell) for cell in column], dtype=np.int64)
        elif name in _FLAGS:
            columns[name] = pd.Series([bool(int(cell)) for cell in column], dtype=bool)
        else:
            columns[name] = pd.Series([float(cell) if cell else math.nan for cell in column], dtype=np.float64)
    return pd.DataFrame(columns)


def no_trials(metrics: Sequence[str]) -> pd.DataFrame:
    """A table of no trials, for a sweep of which none has finished yet."""
    header = (
        "sweep",
        "revision",
        "planner",
        "generator",
        "map_seed",
        "mission_index",
        "outcome",
        "is_finished",
        "reason",
        "cause",
        "end_time_s",
        *metrics,
        "attempt",
        "map_key",
        "planner_key",
        "trial_id",
        "trial_key",
    )
    return trials_of_csv((",".join(header) + "\r\n").encode(), ())


def text_axes_of(specs: Collection[str]) -> set[str]:
    """What of these sweeps' axes and planners' parameters has a value that is no number, by path."""
    found: set[str] = set()
    for spec in map(json.loads, specs):
        for axis in spec.get("axes", []):
            if not all(isinstance(value, (int, float)) for value in axis["values"]):
                found.add(axis["path"])
        for planner in spec.get("planners", []):
            found |= {f"planner.{one['name']}" for one in planner.get("parameters", []) if one.get("is_text")}
    return found


def _map_axes(specs: Collection[str]) -> list[str]:
    """What these sweeps vary of their maps, by path: "map.poisson_radius_m"."""
    paths = [axis["path"] for spec in specs for axis in json.loads(spec).get("axes", [])]
    return list(dict.fromkeys(path for path in paths if path.startswith("map.")))


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
        if name == "map_seed":  # stored as the same bits with a sign
            columns[name] = pd.Series([cell % 2**64 for cell in cells if cell is not None], dtype=np.uint64)
        elif name in _TEXTS:
            columns[name] = pd.Series(cells, dtype=object)
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


def _in_sweeps(choices: Sequence[SweepChoice]) -> tuple[str, list[Any]]:
    places = ", ".join("(?, ?)" for _ in choices)
    return f"(s.sweep, s.revision) IN (VALUES {places})", [value for choice in choices for value in choice]


def read_maps(connection: sqlite3.Connection, choices: Sequence[SweepChoice]) -> pd.DataFrame:
    """The maps of these sweeps, a row each with MAP_COLUMNS and what the sweeps vary of them."""
    rows: list[dict[str, Any]] = []
    specs: list[str] = []
    if choices:
        condition, values = _in_sweeps(choices)
        rows = _rows(
            connection,
            f"SELECT * FROM maps WHERE map_key IN (SELECT s.map_key FROM sweep_missions s WHERE {condition})",
            values,
        )
        specs = [row[0] for row in connection.execute(f"SELECT s.spec_json FROM sweeps s WHERE {condition}", values)]
    for row in rows:
        if row["generator"] in _FROM_FILES:
            row["obstacle_density_1pm2"] = None
    rows.sort(key=lambda row: (row["generator"], row["map_seed"] % 2**64, row["map_key"]))
    frame = frame_of(rows, MAP_COLUMNS)
    map_specs = [json.loads(row["spec_json"]) for row in rows]
    for path in _map_axes(specs):
        frame[path] = _value_column([_map_value(spec, path) for spec in map_specs])
    return frame


def read_missions(connection: sqlite3.Connection, choices: Sequence[SweepChoice]) -> pd.DataFrame:
    """The missions of these sweeps, a row each with MISSION_COLUMNS."""
    rows: list[dict[str, Any]] = []
    if choices:
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
