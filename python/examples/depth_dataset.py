"""A data set of depth images with what is true about them, made without a flight.

    python depth_dataset.py dataset.npz                     # 8 forests with 250 images each
    python depth_dataset.py halls.npz --generator hall --maps 4 --images 100

The file has, for N images from random free places with random level headings:

    depth_m         (N, 48, 64) float32: along the optical axis; +inf: nothing within 15 m; NaN: nearer than 0.1 m
    position_m      (N, 3), heading_rad (N,): the camera in the world frame (ENU, z up; heading from x toward y)
    nearest_m       (N,): distance to the nearest surface, in view or not
    free_m          (N, 9): how far a ball of RADIUS_M can fly straight on in each of the directions, up to 10 m
    direction_rad   (9,): these directions, level, left of the optical axis positive
    best            (N,): the direction with the longest way; of several the one nearest to straight ahead
    map_seed        (N,): whole maps should be held out, not single images

The same options give the same bytes.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import avoidbench
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DIRECTIONS_RAD = np.deg2rad(np.arange(40.0, -41.0, -10.0))
FARTHEST_M, RADIUS_M, PRECISION_M = 10.0, 0.4, 0.02


def free_places(world: avoidbench.World, count: int, random: np.random.Generator) -> Array:
    """(count, 3): places within the flight bounds where the ball fits, world frame, m."""
    low, high = world.flight_bounds_m
    places = np.empty((0, 3))
    for _ in range(1000):
        tried = random.uniform(low, high, (2 * count, 3))
        places = np.concatenate([places, tried[world.nearest(tried).distances_m > RADIUS_M]])
        if len(places) >= count:
            return places[:count]
    raise ValueError(f"{world} has no free places")


def free_ways_m(world: avoidbench.World, places: Array, headings_rad: Array) -> Array:
    """For each place and heading how far the ball can fly, m: steps as long as the nearest surface allows."""
    along = np.stack([np.cos(headings_rad), np.sin(headings_rad), np.zeros_like(headings_rad)], axis=1)
    flown_m = np.zeros(len(places))
    moving = np.arange(len(places))
    while moving.size:
        points = places[moving] + flown_m[moving, np.newaxis] * along[moving]
        left_m = world.nearest(points, limit_m=2.0 * FARTHEST_M).distances_m - RADIUS_M
        flown_m[moving] += np.maximum(left_m, 0.0)
        moving = moving[(left_m > PRECISION_M) & (flown_m[moving] < FARTHEST_M)]
    return np.minimum(flown_m, FARTHEST_M)


def images_of(world: avoidbench.World, count: int) -> dict[str, NDArray[Any]]:
    """The data of one map."""
    random = np.random.default_rng(world.seed)
    places = free_places(world, count, random)
    headings_rad = random.uniform(-np.pi, np.pi, count)
    targets = places + np.stack([np.cos(headings_rad), np.sin(headings_rad), np.zeros(count)], axis=1)
    ways_rad = (headings_rad[:, np.newaxis] + DIRECTIONS_RAD).ravel()
    free_m = free_ways_m(world, np.repeat(places, len(DIRECTIONS_RAD), axis=0), ways_rad).reshape(count, -1)
    by_angle = np.argsort(np.abs(DIRECTIONS_RAD), kind="stable")
    return {
        "depth_m": world.depth(avoidbench.look_at(places, targets), width_px=64, height_px=48),
        "position_m": places,
        "heading_rad": headings_rad,
        "nearest_m": world.nearest(places).distances_m,
        "free_m": free_m,
        "best": by_angle[free_m[:, by_angle].argmax(axis=1)],
        "map_seed": np.full(count, world.seed),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path)
    parser.add_argument("--generator", default="forest", help="as `avoidbench maps list` has them")
    parser.add_argument("--maps", type=int, default=8, help="with the seeds 1, 2, …")
    parser.add_argument("--images", type=int, default=250, help="of each map")
    arguments = parser.parse_args()
    parts = [
        images_of(avoidbench.make_world(arguments.generator, seed=seed), arguments.images)
        for seed in range(1, arguments.maps + 1)
    ]
    data = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    np.savez(arguments.file, direction_rad=DIRECTIONS_RAD, **data)  # type: ignore[arg-type]
    size_mb = arguments.file.stat().st_size / 1e6
    print(
        f"{arguments.file}: {len(data['depth_m'])} images, {size_mb:.0f} MB; nearest surface "
        f"{np.median(data['nearest_m']):.2f} m "
        f"away, best way {np.median(data['free_m'].max(axis=1)):.1f} m (medians)"
    )


if __name__ == "__main__":
    main()
