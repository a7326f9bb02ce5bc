"""Actions in [-1, 1] and depth in bytes are the same flights in other units."""

from __future__ import annotations

from contextlib import closing
from typing import Any

import gymnasium
import numpy as np
import pytest
from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv
from avoidbench.flights import depth_bytes
from flights import ONE, SMALL, changed

GREATEST_M = 15.0  # depth_ideal's
LEAST_M = 0.1


def test_bytes_of_depth_by_hand() -> None:
    depth_m = np.array([0.0, 1e-6, 1.0, 7.5, 14.0, 15.0], np.float32)
    #       unknown, the nearest, 254/15 = 16.9, 127, 237.07, nothing in range
    assert depth_bytes(depth_m, 15.0).tolist() == [0, 1, 18, 128, 238, 255]
    inverse = np.array([0.0, 1.0 / 150.0, 0.5, 1.0], np.float32)  # 254/150 = 1.69
    assert depth_bytes(inverse, 1.0).tolist() == [0, 3, 128, 255]


@pytest.mark.parametrize("greatest", [1.0, 3.0, 10.0, 15.0, 20.0, 30.0, 100.0])
def test_each_byte_means_what_it_says(greatest: float) -> None:
    codes = np.arange(1, 256)
    depth = ((codes - 1) / 254.0 * greatest).astype(np.float32)
    depth[0] = 1e-9
    assert depth_bytes(depth, greatest).tolist() == codes.tolist()


@pytest.mark.parametrize("depth", ["metric", "inverse"])
def test_depth_in_bytes_is_that_in_numbers(depth: str) -> None:
    sweep = changed(SMALL, sensor={"preset": "depth_noisy", "width_px": 32, "height_px": 24})
    options: dict[str, Any] = {"depth": depth, "observe": ["depth"], "autoreset_mode": "SameStep", "seed": 3}
    with (
        closing(AvoidbenchVectorEnv(sweep, 3, threads=1, **options)) as plain,
        closing(AvoidbenchVectorEnv(sweep, 3, threads=1, depth_dtype="uint8", **options)) as coded,
    ):
        assert coded.single_observation_space["depth"] == gymnasium.spaces.Box(0, 255, (1, 24, 32), np.uint8)
        greatest = float(plain.single_observation_space["depth"].high.max())
        assert greatest == (coded.depth_greatest_m if depth == "metric" else 1.0)
        numbers, codes = plain.reset()[0]["depth"], coded.reset()[0]["depth"]
        random, ends, unknown, far = np.random.default_rng(1), 0, 0, 0
        for _ in range(100):
            assert coded.observation_space.contains({"depth": codes})
            assert ((codes == 0) == (numbers == 0.0)).all()
            decoded = (codes - 1.0) / 254.0 * greatest
            assert np.abs(decoded - numbers)[codes > 0].max() <= 1.0001 * greatest / 508.0
            if depth == "metric":
                assert (codes[numbers == greatest] == 255).all()
                far += int((codes == 255).sum())
            unknown += int((codes == 0).sum())
            actions = random.uniform(plain.action_space.low, plain.action_space.high)
            one, other = plain.step(actions), coded.step(actions)
            numbers, codes = one[0]["depth"], other[0]["depth"]
            for slot in np.flatnonzero(one[2] | one[3]):
                ends += 1
                last, coded_last = (step[4]["final_obs"][slot]["depth"] for step in (one, other))
                assert (coded_last == depth_bytes(last, greatest)).all()
        assert ends > 0 and unknown > 0 and (far > 0 or depth == "inverse")


def test_a_single_flight_has_the_bytes_and_pictures_of_a_vector() -> None:
    with (
        closing(AvoidbenchEnv(SMALL, depth_dtype="uint8", render_mode="rgb_array")) as single,
        closing(AvoidbenchEnv(SMALL, render_mode="rgb_array")) as plain,
        closing(AvoidbenchVectorEnv(SMALL, 1, depth_dtype="uint8", copy=False)) as vector,
    ):
        one, many = single.reset(seed=4)[0]["depth"], vector.reset(seed=4)[0]["depth"]
        plain.reset(seed=4)
        assert one.dtype == np.uint8 and (one == many[0]).all() and one.any()
        for _ in range(5):
            one, _ = single.step([1, 0, 0, 1])[0]["depth"], plain.step([1, 0, 0, 1])
            vector.step([[1, 0, 0, 1]])
            assert (one == many[0]).all(), "copy=False: the same array"
            assert (single.render() == plain.render()).all()


def test_rewards_see_the_bytes_and_si_units() -> None:
    seen: list[Any] = []

    def reward(observation: Any, actions: Any, *_: Any) -> Any:
        seen.append((observation["depth"].dtype, actions.copy()))
        return np.zeros(len(actions))

    env = AvoidbenchEnv(ONE, depth_dtype="uint8", unit_actions=True, reward=reward)
    env.reset(seed=1)
    env.step([0.5, -0.25, 0.0, 1.0])
    plain = AvoidbenchEnv(ONE)
    assert seen[0][0] == np.uint8
    assert seen[0][1][0] == pytest.approx(np.array([0.5, -0.25, 0.0, 1.0]) * plain.action_space.high)


@pytest.mark.parametrize("action", ["velocity", "acceleration", "rates_thrust", "trajectory"])
def test_unit_actions_fly_as_those_they_stand_for(action: str) -> None:
    options: dict[str, Any] = {"action": action, "observe": ["pose"], "trajectory_points": 2}
    with (
        closing(AvoidbenchVectorEnv(SMALL, 2, threads=1, **options)) as plain,
        closing(AvoidbenchVectorEnv(SMALL, 2, threads=1, unit_actions=True, **options)) as unit,
    ):
        low, high = plain.action_space.low.astype(np.float64), plain.action_space.high.astype(np.float64)
        assert unit.single_action_space == gymnasium.spaces.Box(-1.0, 1.0, (low.shape[1],), np.float32)
        if action == "rates_thrust":
            assert (low[:, 3] == 0.0).all() and (high[:, 3] > 9.81).all()
        plain.reset(seed=1), unit.reset(seed=1)
        random = np.random.default_rng(2)
        for _ in range(20):
            numbers = random.uniform(-1.0, 1.0, low.shape)
            one = plain.step(low + (numbers + 1.0) / 2.0 * (high - low))
            other = unit.step(numbers)
            # Bounds are float32 in a space and float64 in the flights.
            assert np.allclose(one[0]["pose"], other[0]["pose"], atol=1e-4)
            assert (one[2] == other[2]).all()


def test_the_ends_of_the_units_are_the_vehicles_limits() -> None:
    seen: list[Any] = []

    def reward(_: Any, actions: Any, *__: Any) -> Any:
        seen.append(actions[0].tolist())
        return np.zeros(1)

    env = AvoidbenchEnv(
        {**ONE, "vehicle": {"max_speed_mps": 3, "max_yaw_rate_radps": 2}}, unit_actions=True, reward=reward
    )
    env.reset(seed=1)
    for action in ([1, 1, 1, 1], [-1, -1, -1, -1], [0, 0, 0, 0], [2, 0, 0, 0]):
        env.step(action)
    assert seen == [[3, 3, 3, 2], [-3, -3, -3, -2], [0, 0, 0, 0], [6, 0, 0, 0]]


def test_wrong_options_are_refused() -> None:
    with pytest.raises(ValueError, match="depth_dtype: expected float32 or uint8, got 'uint16'"):
        AvoidbenchEnv(ONE, depth_dtype="uint16")
    with pytest.raises(TypeError, match="depth_dtype: expected a word, got type"):
        AvoidbenchEnv(ONE, depth_dtype=np.uint8)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="unit_actions: expected True or False, got str"):
        AvoidbenchVectorEnv(ONE, 2, unit_actions="unit")  # type: ignore[arg-type]
    env = AvoidbenchEnv(ONE, observe=["state"], depth_dtype="uint8")
    assert np.isnan(env.depth_greatest_m), "nothing to code"


def test_registered_environments_take_both() -> None:
    with gymnasium.make("avoidbench/Hall-v0", unit_actions=True, depth_dtype="uint8") as env:
        assert env.action_space == gymnasium.spaces.Box(-1.0, 1.0, (4,), np.float32)
        assert env.observation_space["depth"].dtype == np.uint8
        env.reset(seed=1)
        env.step(np.zeros(4, np.float32))
    with closing(gymnasium.make_vec("avoidbench/Hall-v0", num_envs=2, unit_actions=True)) as envs:
        assert envs.single_action_space == gymnasium.spaces.Box(-1.0, 1.0, (4,), np.float32)
