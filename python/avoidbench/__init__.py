"""Flies sweeps with avoidbench and reads their results."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from avoidbench.database_file import ResultsError
from avoidbench.program import ProgramError

if TYPE_CHECKING:
    from avoidbench.comparison import Comparison
    from avoidbench.results import Results, read
    from avoidbench.sweep_run import run

__all__ = ["Comparison", "ProgramError", "Results", "ResultsError", "read", "run"]

# These take pandas, which is imported when one of them is used.
_MODULES = {"Comparison": "comparison", "Results": "results", "read": "results", "run": "sweep_run"}


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
