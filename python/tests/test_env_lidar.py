"""Environments show what lidars see: in their places, in the lidar's frame, with and without a camera."""

from __future__ import annotations

import warnings
from typing import Any

import avoidbench
import gymnasium
import numpy as np
import pytest
from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv, InputError
from avoidbench.registration import FOREST_LIDAR
from flights import ONE, SMALL, changed, digest_of_random_flights
from gymnasium.utils.env_checker import check_env

EXACT = {"preset": "velodyne_16", "rings": 4, "columns": 60, "range_sigma_m": 0, "dropout_ratio": 0, "max_range_m": 5}
"""240 shots at 10 Hz, without noise, that see half of a hall."""
MOUNTED: dict[str, Any] = {**EXACT, "position_body_m": [0.1, 0.0, 0.2], "yaw_deg": 90}
ALONE: dict[str, Any] = {"name": "alone", "kind": "none", "lidars": [MOUNTED]}
BY_LIDAR = {**ONE, "sensor": ALONE}


def rotation_of(q: np.ndarray) -> np.ndarray:
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


@pytest.mark.parametrize("depth", ["inverse", "metric"])
@pytest.mark.parametrize("observe", [["points"], ["ranges"], ["points", "ranges", "state", "goal", "pose", "imu"]])
def test_the_checker_passes_for_a_lidar_alone(observe: list[str], depth: str) -> None:
    env = AvoidbenchEnv(BY_LIDAR, observe=observe, depth=depth, render_mode="rgb_array")
    shapes = {"points": (1, 240, 3), "ranges": (1, 240)}
    for name in set(observe) & set(shapes):
        assert env.observation_space[name].shape == shapes[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # places have no limits that always hold
        check_env(env)


@pytest.mark.parametrize("deskewed", [True, False])
def test_points_lie_on_the_maps_surfaces(deskewed: bool) -> None:
    sweep = {**BY_LIDAR, "sensor": {**ALONE, "lidars": [{**MOUNTED, "deskewed": deskewed}]}}
    env = AvoidbenchEnv(sweep, observe=["points", "ranges", "pose"], depth="metric")
    world = avoidbench.make_world({**sweep, "planners": ["straight_line"]})
    first, _ = env.reset(seed=1)
    assert not first["points"].any() and not first["ranges"].any(), "nothing is known before the first sweep"
    for step in range(1, 19):
        seen = env.step([2.0, 0.0, 0.0, 0.5])[0]
        if step == 2:
            assert not seen["points"].any()
        # Sweeps end at 0.1, 0.2, … s, with each third step.
        if step % 3 != 0:
            continue
        points, ranges, pose = seen["points"][0], seen["ranges"][0], seen["pose"]
        met = points.any(axis=1)
        assert 60 < met.sum() < 240
        # De-skewed it may lie a little beyond the greatest range from where the lidar is now.
        far_m = np.linalg.norm(points[met].astype(np.float64), axis=1)
        assert np.allclose(ranges[met], np.minimum(far_m, 5.0), rtol=1e-6)
        assert (ranges[~met] == 5.0).all(), "a miss is the greatest range"
        # The lidar's x is the body's y, and its y the body's -x.
        in_body = points[met].astype(np.float64) @ np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]) + [0.1, 0.0, 0.2]
        in_world = in_body @ rotation_of(pose[7:11]).T + pose[1:4]
        away_m = world.nearest(in_world, limit_m=5.0).distances_m
        if deskewed:
            assert away_m.max() < 2e-3
    if not deskewed:
        assert away_m.max() > 0.05, "each point is as it was seen at its own time"


def test_shots_of_a_spinning_lidar_are_an_image() -> None:
    env = AvoidbenchEnv(BY_LIDAR, observe=["points"])
    env.reset(seed=1)
    for _ in range(3):
        seen = env.step(np.zeros(4))[0]
    grid = seen["points"][0].reshape(60, 4, 3)  # columns, rings
    met = grid.any(axis=2)
    azimuth = np.arctan2(grid[..., 1], grid[..., 0])
    elevation = np.arctan2(grid[..., 2], np.hypot(grid[..., 0], grid[..., 1]))
    wanted = (np.arange(60) / 60.0 - 0.5) * 2.0 * np.pi
    # It leans a little, and begins and ends behind.
    around = np.angle(np.exp(1j * (azimuth - wanted[:, None])))
    assert np.abs(around[met]).max() < 0.05
    assert np.abs(elevation - np.radians([-15.0, -5.0, 5.0, 15.0]))[met].max() < 0.05


def test_two_lidars_and_a_camera() -> None:
    lidars = [EXACT, {**EXACT, "columns": 30, "max_range_m": 8.0, "rate_hz": 20}]
    sweep = {**ONE, "sensor": {**ONE["sensor"], "lidars": lidars}}
    env = AvoidbenchVectorEnv(
        sweep, 2, threads=2, observe=["depth", "points", "ranges"], depth="metric", copy=False, seed=3
    )
    assert env.single_observation_space["points"].shape == (2, 240, 3)
    seen, _ = env.reset()
    for _ in range(6):
        env.step(np.zeros((2, 4)))
    assert env.observation_space.contains(seen)
    assert seen["points"][:, :, :120].any(axis=(2, 3)).all() and not seen["points"][:, 1, 120:].any()
    assert not seen["ranges"][:, 1, 120:].any(), "the second one has 120 shots"
    assert seen["ranges"][:, :, :120].min() > 0.0 and seen["ranges"].max() == 8.0
    # What lidars see changes no picture.
    alone = AvoidbenchVectorEnv(ONE, 2, threads=1, observe=["depth"], depth="metric", copy=False, seed=3)
    pictures, _ = alone.reset()
    for _ in range(6):
        alone.step(np.zeros((2, 4)))
    assert np.array_equal(pictures["depth"], seen["depth"])


def test_metric_and_inverse_ranges_are_of_the_same_sweeps() -> None:
    both = []
    for depth in ("metric", "inverse"):
        env = AvoidbenchEnv(BY_LIDAR, observe=["ranges"], depth=depth)
        env.reset(seed=1)
        both.append([env.step(np.zeros(4))[0]["ranges"] for _ in range(3)][-1])
    metric, inverse = both
    assert (metric > 0.5).all() and (metric == 5.0).any()
    assert np.allclose(inverse, 0.5 / metric, rtol=1e-6)


def test_bits_are_the_same_for_any_number_of_threads() -> None:
    sweep = {**SMALL, "sensor": {"preset": "mid360_like", "lidars": [{"preset": "mid360_like", "points_per_s": 5000}]}}
    options: dict[str, Any] = {"observe": ["points", "ranges", "goal"]}
    one = digest_of_random_flights(sweep, 3, 1, 60, **options)
    assert one == digest_of_random_flights(sweep, 3, 3, 60, **options)


def test_the_forest_by_lidar() -> None:
    with gymnasium.make("avoidbench/ForestLidar-v0", render_mode="rgb_array") as env:
        assert set(env.observation_space.spaces) == {"ranges", "state", "goal"}  # type: ignore[attr-defined]
        env.reset(seed=1)
        dark = env.render()
        assert dark.shape == (200, 200, 3) and not dark.any(), "no sweep yet"
        for _ in range(3):
            seen = env.step(np.zeros(4, np.float32))[0]
        assert seen["ranges"].shape == (1, 1440) and env.render().any()
    again = AvoidbenchEnv(FOREST_LIDAR, observe=["points", "ranges"], render_mode="rgb_array")
    again.reset(seed=1)
    for _ in range(3):
        seen = again.step(np.zeros(4, np.float32))[0]
    picture = again.render()
    assert picture is not None
    near = seen["points"][0][np.abs(seen["points"][0][:, :2]).max(axis=1) < 9.5]
    for x_m, y_m, _ in near[near.any(axis=1)][::20]:
        assert picture[round(100 - 10 * float(x_m)), round(100 - 10 * float(y_m))].any(), "forward is up, left is left"


@pytest.mark.parametrize(
    ("sensor", "observe", "options", "text"),
    [
        (SMALL["sensor"], ["points"], {}, "points and ranges come from lidars, and the sensor has none"),
        (SMALL["sensor"], ["depth", "ranges"], {}, "points and ranges come from lidars"),
        (ALONE, ["depth", "state"], {}, "come from cameras, and the sensor has none: observe ranges or points"),
        (ALONE, ["color"], {}, "come from cameras"),
        ({**ALONE, "lidars": [{**EXACT, "min_range_m": 0}]}, ["ranges"], {}, "lidars' min_range_m, which is 0"),
    ],
)
def test_what_the_sensor_lacks_is_told(sensor: Any, observe: list[str], options: dict[str, Any], text: str) -> None:
    with pytest.raises(InputError, match=text):
        AvoidbenchEnv(changed(ONE) | {"sensor": sensor}, observe=observe, **options)


def test_pictures_need_something_to_draw() -> None:
    with pytest.raises(ValueError, match="depth, points or ranges"):
        AvoidbenchEnv(BY_LIDAR, observe=["state"], render_mode="rgb_array")
    with pytest.raises(ValueError, match=r"did you mean points\?"):
        AvoidbenchEnv(BY_LIDAR, observe=["point"])
