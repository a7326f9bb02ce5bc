"""Sweeps and policies that tests of the environments share."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

SMALL: dict[str, Any] = {
    "sweep": "small",
    "maps": {"generator": "hall", "area_m": [14, 16], "poisson_radius_m": 3.0, "seeds": [1, 2]},
    "trials": 2,
    "mission": {"time_limit_s": 3},
    "sensor": {"preset": "depth_ideal", "width_px": 16, "height_px": 12},
}
"""Two small halls with two missions each, small pictures and short flights."""

ONE: dict[str, Any] = {
    **SMALL,
    "sweep": "one",
    "maps": {**SMALL["maps"], "seeds": [1]},
    "trials": 1,
    "mission": {"time_limit_s": 1},
}
"""One trial of a second, 30 steps."""


def changed(sweep: dict[str, Any], **fields: Any) -> dict[str, Any]:
    """`sweep` with other fields; those that are dicts are joined."""
    both = {
        name: {**sweep[name], **value} for name, value in fields.items() if isinstance(value, dict) and name in sweep
    }
    return {**sweep, **fields, **both}


def to_goal(observation: dict[str, Any], speed_mps: float = 2.0) -> np.ndarray:
    """Velocities in the heading frame, straight to the goals."""
    goal = np.asarray(observation["goal"], np.float64)
    velocity = speed_mps * goal / np.linalg.norm(goal, axis=-1, keepdims=True)
    return np.concatenate([velocity, np.zeros((*goal.shape[:-1], 1))], axis=-1)


def add_to(digest: Any, value: Any) -> None:
    """All bytes of arrays, texts and numbers in `value`, by name."""
    if isinstance(value, dict):
        for name in sorted(value):
            digest.update(name.encode())
            add_to(digest, value[name])
    elif isinstance(value, np.ndarray) and value.dtype == object:
        for item in value:
            add_to(digest, item)
    else:
        array = np.asarray(value)
        digest.update(f"{array.dtype}{array.shape}".encode() if array.dtype.kind != "U" else str(value).encode())
        digest.update(array.tobytes())


def digest_of_random_flights(sweep: dict[str, Any], slots: int, threads: int, steps: int, **options: Any) -> str:
    """Of all that `steps` steps of random actions give."""
    from avoidbench.env import AvoidbenchVectorEnv

    env = AvoidbenchVectorEnv(sweep, slots, threads=threads, **options)
    random = np.random.default_rng(11)
    digest = hashlib.sha256()
    observation, _ = env.reset(seed=5)
    add_to(digest, observation)
    low, high = env.action_space.low, env.action_space.high
    for _ in range(steps):
        for part in env.step(random.uniform(low, high)):
            add_to(digest, part)
    env.close()
    return digest.hexdigest()
