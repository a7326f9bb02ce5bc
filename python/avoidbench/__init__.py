"""Obstacle-avoidance planners for multirotors in simulated maps: the program avoidbench, from Python.

World frame: ENU, z up, metres. Cameras: RDF (x right, y down, z forward). `T_a_b` takes b's coordinates to a's.
`gymnasium.make` knows the environments of avoidbench.registration once this is imported.

Without the extension avoidbench._core, as next to an installed program or in a folder of sources, results can be read
and planners written; the rest raises ImportError when it is used. If the program has started a planner, only what
planners need is imported: NumPy is enough."""

import contextlib
import os
from importlib import import_module
from typing import TYPE_CHECKING, Any

from avoidbench.planner import Planner

_IS_PLANNER = "AVOIDBENCH_PLANNER_FDS" in os.environ


def _has_extension() -> bool:
    try:
        import_module("avoidbench._extension")
    except ImportError:
        return False
    return True


_IS_WHOLE = not _IS_PLANNER and _has_extension()

if TYPE_CHECKING or _IS_WHOLE:
    from avoidbench._core import version as __version__
    from avoidbench._extension import InputError
    from avoidbench.database_file import ResultsError
    from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv, Reward
    from avoidbench.program import ProgramError
    from avoidbench.world import Missions, Nearest, Obstacle, Occupancy, World, look_at, make_world

if not _IS_PLANNER:
    with contextlib.suppress(ImportError):  # who only reads results needs no Gymnasium
        import_module("avoidbench.registration").register()

if TYPE_CHECKING:
    from avoidbench.comparison import Comparison
    from avoidbench.flying import fly
    from avoidbench.results import Results, read
    from avoidbench.serving import serve
    from avoidbench.sweep_run import run

__all__ = [
    "__version__",
    "AvoidbenchEnv",
    "AvoidbenchVectorEnv",
    "Comparison",
    "InputError",
    "Missions",
    "Nearest",
    "Obstacle",
    "Occupancy",
    "Planner",
    "ProgramError",
    "Results",
    "ResultsError",
    "Reward",
    "World",
    "fly",
    "look_at",
    "make_world",
    "read",
    "run",
    "serve",
]

# Imported when one of them is used, unless that was done above: most take pandas or the extension.
_MODULES = {
    "AvoidbenchEnv": "env",
    "AvoidbenchVectorEnv": "env",
    "Comparison": "comparison",
    "InputError": "_extension",
    "Missions": "world",
    "Nearest": "world",
    "Obstacle": "world",
    "Occupancy": "world",
    "ProgramError": "program",
    "Results": "results",
    "ResultsError": "database_file",
    "Reward": "env",
    "World": "world",
    "fly": "flying",
    "look_at": "world",
    "make_world": "world",
    "read": "results",
    "run": "sweep_run",
    "serve": "serving",
}


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return import_module(f"{__name__}._extension").core.version
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
