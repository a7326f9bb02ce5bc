"""A policy without learning: flies toward the gap in the depth image that is nearest to the goal's direction. Prints
what came of it.

python scripted_policy.py                        # 64 trials in forests, 32 at once
python scripted_policy.py --hall --episodes 100
"""

from __future__ import annotations

import argparse
from collections import Counter
from typing import Any

import avoidbench
import numpy as np
from avoidbench.registration import FOREST, HALL
from numpy.typing import NDArray

Array = NDArray[np.float64]

MAX_SPEED_MPS = 2.5
FIELD_OF_VIEW_RAD = np.pi / 2  # of depth_ideal
WAY_M = 5.0  # farther things do not matter yet
WIDTH_M = 0.8  # of the way that has to be free, to each side


def free_ways(depth_m: Array) -> tuple[Array, Array]:
    """The directions of the image's columns, left of the nose positive, and (N, columns): how far each is free for a
    body with a width."""
    height, columns = depth_m.shape[1:]
    focal_px = columns / 2 / np.tan(FIELD_OF_VIEW_RAD / 2)
    angles_rad = np.arctan(((columns - 1) / 2 - np.arange(columns)) / focal_px)
    nearest_m = depth_m[:, height // 3 : 2 * height // 3].min(axis=1) / np.cos(angles_rad)
    free_m = np.empty_like(nearest_m)
    for column, angle_rad in enumerate(angles_rad):
        off_rad = np.abs(angles_rad - angle_rad)
        is_in_way = nearest_m * np.sin(off_rad) < WIDTH_M
        free_m[:, column] = np.where(is_in_way, nearest_m, WAY_M).min(axis=1)
    return angles_rad, np.minimum(free_m, WAY_M)


def actions(seen: dict[str, NDArray[Any]]) -> Array:
    """Velocities in the heading frame and yaw rates, (N, 4), from metric depth and the way to the goal."""
    angles_rad, free_m = free_ways(seen["depth"][:, 0].astype(np.float64))
    goal_m = seen["goal"].astype(np.float64)
    bearing_rad = np.arctan2(goal_m[:, 1], goal_m[:, 0])
    off_rad = np.abs(angles_rad - np.clip(bearing_rad, angles_rad.min(), angles_rad.max())[:, np.newaxis])
    best = (free_m - 2.0 * off_rad).argmax(axis=1)
    rows = np.arange(len(best))
    speed_mps = np.minimum(0.6 * free_m[rows, best], MAX_SPEED_MPS)
    speed_mps = np.where(np.abs(bearing_rad) > FIELD_OF_VIEW_RAD / 2, 0.3, speed_mps)  # first look there
    way_rad = angles_rad[best]
    up_mps = np.clip(goal_m[:, 2], -1.0, 1.0)
    yaw_rate_radps = np.clip(way_rad + 0.5 * bearing_rad, -1.5, 1.5)
    return np.stack([speed_mps * np.cos(way_rad), speed_mps * np.sin(way_rad), up_mps, yaw_rate_radps], axis=1)


def fly(sweep: dict[str, Any], episodes: int, slots: int, seed: int, threads: int | None = None) -> Counter[str]:
    """Outcomes of at least so many episodes, as many in each slot: else those that end soon would count more often."""
    flights = avoidbench.AvoidbenchVectorEnv(sweep, slots, depth="metric", seed=seed, threads=threads)
    wanted = -(-episodes // slots)
    flown = np.zeros(slots, int)
    outcomes: Counter[str] = Counter()
    seen, _ = flights.reset()
    while (flown < wanted).any():
        seen, _, terminated, truncated, infos = flights.step(actions(seen))
        for slot in np.flatnonzero(terminated | truncated):
            if flown[slot] < wanted:
                outcomes[infos["outcome"][slot]] += 1
                flown[slot] += 1
    flights.close()
    return outcomes


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hall", action="store_true", help="halls of cylinders instead of forests")
    parser.add_argument("--episodes", type=int, default=64)
    parser.add_argument("--slots", type=int, default=32, help="flights at once")
    parser.add_argument("--seed", type=int, default=1, help="chooses the trials")
    arguments = parser.parse_args()
    outcomes = fly(HALL if arguments.hall else FOREST, arguments.episodes, arguments.slots, arguments.seed)
    for outcome, count in outcomes.most_common():
        print(f"{outcome:14} {count:4} {count / outcomes.total():6.0%}")


if __name__ == "__main__":
    main()
