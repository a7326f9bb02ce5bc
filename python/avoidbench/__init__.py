"""Obstacle-avoidance planners for multirotors in simulated maps: the program avoidbench, from Python.

World frame: ENU, z up, metres. Cameras: RDF (x right, y down, z forward). `T_a_b` takes b's coordinates to a's.
`gymnasium.make` knows the environments of avoidbench.registration once this is imported."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from avoidbench import _location as _location  # first: tells the extension where the program lies
from avoidbench._core import InputError
from avoidbench.database_file import ResultsError
from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv, Reward
from avoidbench.flying import fly
from avoidbench.planner import Planner
from avoidbench.program import ProgramError
from avoidbench.registration import register as _register
from avoidbench.world import Missions, Nearest, Obstacle, Occupancy, World, look_at, make_world

if TYPE_CHECKING:
    from avoidbench.comparison import Comparison
    from avoidbench.results import Results, read
    from avoidbench.sweep_run import run

InputError.__module__ = __name__
_register()

__all__ = [
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
]

# These take pandas, which is imported when one of them is used.
_MODULES = {"Comparison": "comparison", "Results": "results", "read": "results", "run": "sweep_run"}


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
