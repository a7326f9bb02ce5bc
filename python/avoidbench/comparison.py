"""Results compared with a base by `avoidbench compare`."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

from avoidbench.program import path_argument, run_program, warn_of
from avoidbench.tables import report_frame

_EXIT_PASSED, _EXIT_FAILED = 0, 1


@dataclass(frozen=True, repr=False)
class Comparison:
    """The result of `avoidbench compare BASE NEW`. print() shows it as the program does.

    Attributes:
        passed: no regression; with `exact` no difference; with `complete` no trial is missing.
        text: the comparison as a table for people.
        data: the complete result, as in the program's JSON.
    """

    passed: bool
    text: str
    data: dict[str, Any]

    @property
    def metrics(self) -> pd.DataFrame:
        """A row a planner and metric: means of base and new, change with its 95 % interval, p, verdict.
        Empty for an exact comparison, which has `differences`."""
        rows = self.data["metrics"] if "planners" in self.data else []
        return report_frame(rows)

    @property
    def differences(self) -> pd.DataFrame:
        """The differences found by an exact comparison, a row each. Empty for any other comparison."""
        return report_frame(self.data.get("differences", []))

    def __repr__(self) -> str:
        return self.text


def _options(
    metrics: Sequence[str] | str | None,
    alpha: float | None,
    min_effect: str | float | None,
    tolerances: str | os.PathLike[str] | None,
) -> list[str]:
    options = []
    if metrics is not None:
        options.append("--metrics=" + (metrics if isinstance(metrics, str) else ",".join(metrics)))
    if alpha is not None:
        options.append(f"--alpha={float(alpha)!r}")
    if min_effect is not None:
        share = min_effect if isinstance(min_effect, str) else f"{100 * float(min_effect)!r}%"
        options.append(f"--min-effect={share}")
    if tolerances is not None:
        options.append(f"--tolerances={os.fspath(tolerances)}")
    return options


def compare_files(
    base: str,
    new: str,
    *,
    sweep: str | None,
    planner: str | None,
    exact: bool,
    complete: bool,
    gate_measured: bool,
    metrics: Sequence[str] | str | None,
    alpha: float | None,
    min_effect: str | float | None,
    tolerances: str | os.PathLike[str] | None,
) -> Comparison:
    """Compares two files; the arguments are those of Results.compare().

    Raises:
        ProgramError: there is nothing to compare, or an option is wrong.
    """
    arguments = ["compare", path_argument(base), path_argument(new), *_options(metrics, alpha, min_effect, tolerances)]
    arguments += [f"--sweep={sweep}"] if sweep else []
    arguments += [f"--planner={planner}"] if planner else []
    flags = {"--exact": exact, "--complete": complete, "--gate-measured": gate_measured}
    arguments += [flag for flag, is_given in flags.items() if is_given]
    codes = (_EXIT_PASSED, _EXIT_FAILED)
    data = run_program([*arguments, "--format=json"], good_exit_codes=codes, warns=False)
    table = run_program([*arguments, "--format=table"], good_exit_codes=codes, warns=False)
    warn_of(table.stderr, stacklevel=3)
    return Comparison(passed=data.exit_code == _EXIT_PASSED, text=table.text, data=json.loads(data.stdout))
