"""The program's report as data."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from typing import Any

from avoidbench.database_file import ResultsError
from avoidbench.program import run_program

_INFINITIES = ("inf", "-inf")
_TRIES = 3  # a run may store a trial between two looks


def _is_null_or_same(value: Any, cell: str) -> bool:
    if value is None or isinstance(value, (str, bool)):
        return True
    return float(cell) == float(value)


def _with_infinities(sweeps: list[dict[str, Any]], cells: list[dict[str, str]]) -> bool:
    """Puts the infinities of the report's CSV where its JSON, which has no word for them, says null. Returns
    whether the two are of the same results; only then all is put."""
    place = 0
    for sweep in sweeps:
        for name, rows in sweep["tables"].items():
            for row in rows:
                for key in row:
                    if place == len(cells) or cells[place]["name"] != key:
                        continue  # says which row it is: a column of its own there
                    cell = cells[place]
                    if (cell["sweep"], cell["table"]) != (sweep["sweep"], name) or not _is_null_or_same(
                        row[key], cell["value"]
                    ):
                        return False
                    if row[key] is None and cell["value"] in _INFINITIES:
                        row[key] = float(cell["value"])
                    place += 1
    return place == len(cells)


def read_report(arguments: Sequence[str], warns: bool = True) -> list[dict[str, Any]]:
    """The output of `avoidbench report --format json`, with infinities: for each sweep "sweep", "title", "warnings"
    and "tables", by name lists of rows.

    Args:
        arguments: of the program, from `report` on, without the format.
        warns: whether the program's warnings become Python's.

    Raises:
        ProgramError: no trial has finished, or an argument is wrong.
        ResultsError: the results change faster than they can be read.
    """
    for _ in range(_TRIES):
        sweeps: list[dict[str, Any]] = json.loads(run_program([*arguments, "--format=json"], warns=warns).stdout)
        text = run_program([*arguments, "--format=csv"], warns=False).text
        cells = list(csv.DictReader(io.StringIO(text, newline=""), strict=True))
        has_infinity = any(cell["value"] in _INFINITIES for cell in cells)
        if not has_infinity or _with_infinities(sweeps, cells):
            return sweeps
    raise ResultsError("the results change while they are read: try again when fewer trials are being stored")
