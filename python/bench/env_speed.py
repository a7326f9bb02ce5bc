"""What Python adds to a step of the vector environment: the time of env.step() less that of the C++ call within it.

    python python/bench/env_speed.py [--slots 64] [--steps 300] [--repeats 5]

Prints medians over the repeats: microseconds for a call of all slots, and for one flight's step (a slot's share of
it)."""

import argparse
import statistics
import time
from typing import Any

import avoidbench
import numpy as np

SWEEP: dict[str, Any] = {
    "sweep": "speed",
    "trials": 20,
    "maps": {"generator": "hall"},
    "sensor": {"preset": "depth_ideal", "width_px": 64, "height_px": 48},
    "axes": {"map_seed": [1, 2, 3, 4]},
}
CASES: dict[str, dict[str, Any]] = {
    "state and goal": {"observe": ["state", "goal"]},
    "state and goal, copy=False": {"observe": ["state", "goal"], "copy": False},
    "depth 64x48, state, goal": {"observe": ["depth", "state", "goal"]},
    "depth 64x48, state, goal, copy=False": {"observe": ["depth", "state", "goal"], "copy": False},
}


class Timed:
    """The extension's flights; adds up the time of step()."""

    def __init__(self, core: Any) -> None:
        self._core = core
        self.taken_s = 0.0

    def __getattr__(self, name: str) -> Any:
        return getattr(self._core, name)

    def step(self, *arguments: Any) -> None:
        before = time.perf_counter()
        self._core.step(*arguments)
        self.taken_s += time.perf_counter() - before


def own_share_us(envs: avoidbench.AvoidbenchVectorEnv, steps: int) -> float:
    """Of one call, the mean over the steps in which no episode ends: those gather metrics."""
    flights = envs._open()
    timed = flights.core
    seen = {name: array.copy() for name, array in flights.views.items()}
    actions = np.zeros((envs.num_envs, 4))
    shares: list[float] = []
    for _ in range(steps):
        goal = seen["goal"].astype(np.float64)
        actions[:, :3] = 2.0 * goal / np.maximum(np.linalg.norm(goal, axis=1, keepdims=True), 1e-9)
        timed.taken_s = 0.0
        before = time.perf_counter()
        seen, _, terminated, truncated, _ = envs.step(actions)
        took_s = time.perf_counter() - before
        if not (terminated | truncated).any():
            shares.append(took_s - timed.taken_s)
    return 1e6 * statistics.median(shares)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, value in (("slots", 64), ("steps", 300), ("repeats", 5)):
        parser.add_argument(f"--{name}", type=int, default=value)
    arguments = parser.parse_args()
    print(f"{'':38} {'a call':>10} {'a step':>10}   (microseconds, {arguments.slots} slots)")
    for name, options in CASES.items():
        envs = avoidbench.AvoidbenchVectorEnv(SWEEP, arguments.slots, **options)
        envs.reset(seed=1)
        flights: Any = envs._open()
        flights.core = Timed(flights.core)
        share_us = statistics.median(own_share_us(envs, arguments.steps) for _ in range(arguments.repeats))
        envs.close()
        print(f"{name:38} {share_us:10.1f} {share_us / arguments.slots:10.2f}")


if __name__ == "__main__":
    main()
