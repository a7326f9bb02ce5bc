"""Obstacle-avoidance planners for multirotors in simulated maps: the program avoidbench, from Python.

World frame: ENU, z up, metres. Cameras: RDF (x right, y down, z forward). `T_a_b` takes b's coordinates to a's."""

from avoidbench import _location as _location  # first: tells the extension where the program lies
from avoidbench._core import InputError
from avoidbench.comparison import Comparison
from avoidbench.database_file import ResultsError
from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv, Reward
from avoidbench.program import ProgramError
from avoidbench.registration import register as _register
from avoidbench.results import Results, read
from avoidbench.sweep_run import run
from avoidbench.world import Missions, Nearest, Obstacle, Occupancy, World, look_at, make_world

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
    "ProgramError",
    "Results",
    "ResultsError",
    "Reward",
    "World",
    "look_at",
    "make_world",
    "read",
    "run",
]
