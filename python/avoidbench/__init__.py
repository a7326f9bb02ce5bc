"""Obstacle-avoidance planners for multirotors in simulated maps: the program avoidbench, from Python.

World frame: ENU, z up, metres. Cameras: RDF (x right, y down, z forward). `T_a_b` takes b's coordinates to a's.
`gymnasium.make` knows the environments of avoidbench.registration once this is imported.

If the package has no extension, as next to an installed program, or if the program has started a planner, only what
planners need is imported: NumPy is enough."""

import os
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from avoidbench.planner import Planner

_IS_WHOLE = "AVOIDBENCH_PLANNER_FDS" not in os.environ and find_spec("avoidbench._core") is not None

if TYPE_CHECKING or _IS_WHOLE:
    from avoidbench import _location as _location  # first: tells the extension where the program lies
    from avoidbench._core import InputError
    from avoidbench._core import version as __version__
    from avoidbench.database_file import ResultsError
    from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv, Reward
    from avoidbench.program import ProgramError
    from avoidbench.registration import register as _register
    from avoidbench.world import Missions, Nearest, Obstacle, Occupancy, World, look_at, make_world

    InputError.__module__ = __name__
    _register()

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

# Imported when one of them is used: most take pandas.
_MODULES = {
    "Comparison": "comparison",
    "Results": "results",
    "fly": "flying",
    "read": "results",
    "run": "sweep_run",
    "serve": "serving",
}
# And these the extension, where it was not imported.
_OF_EXTENSION = {
    "AvoidbenchEnv": "env",
    "AvoidbenchVectorEnv": "env",
    "InputError": "_core",
    "Missions": "world",
    "Nearest": "world",
    "Obstacle": "world",
    "Occupancy": "world",
    "ProgramError": "program",
    "ResultsError": "database_file",
    "Reward": "env",
    "World": "world",
    "look_at": "world",
    "make_world": "world",
}


def __getattr__(name: str) -> Any:
    if name == "__version__" and not _IS_WHOLE:
        return import_module(f"{__name__}._core").version
    module = _MODULES.get(name) or (None if _IS_WHOLE else _OF_EXTENSION.get(name))
    if module is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{module}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
