"""Obstacle-avoidance planners for multirotors in simulated maps: the program avoidbench, from Python.

World frame: ENU, z up, metres. Cameras: RDF (x right, y down, z forward). `T_a_b` takes b's coordinates to a's."""

from avoidbench import _location as _location  # first: tells the extension where the program lies
from avoidbench._core import InputError
from avoidbench.world import Missions, Nearest, Obstacle, Occupancy, World, look_at, make_world

InputError.__module__ = __name__

__all__ = [
    "InputError",
    "Missions",
    "Nearest",
    "Obstacle",
    "Occupancy",
    "World",
    "look_at",
    "make_world",
]
