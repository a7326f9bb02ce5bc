"""Environments keep Gymnasium's rules, and their episodes are the sweep's trials."""

from __future__ import annotations

import copy
import warnings
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import avoidbench
import gymnasium
import numpy as np
import pytest
from avoidbench.env import OBSERVATIONS, AvoidbenchEnv, AvoidbenchVectorEnv, Reward
from avoidbench.registration import IDS
from conftest import fly
from flights import ONE, SMALL, changed, to_goal
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers.vector import RecordEpisodeStatistics, RescaleAction

HOVER = np.zeros(4, np.float32)
# Places and velocities have no limits that always hold, and actions are in SI units.
EXPECTED_WARNINGS = (
    "minimum value is -infinity",
    "maximum value is infinity",
    "we recommend using a symmetric and normalized space",
)


def same(one: Any, other: Any) -> bool:
    """Whether two results have the same bits, of whatever dicts and arrays they are made."""
    if isinstance(one, dict):
        return (
            isinstance(other, dict) and one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
        )
    if isinstance(one, tuple) or (isinstance(one, np.ndarray) and one.dtype == object):
        return len(one) == len(other) and all(same(a, b) for a, b in zip(one, other, strict=True))
    a, b = np.asarray(one), np.asarray(other)
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


@pytest.mark.parametrize("name", IDS)
def test_the_checker_passes_for_each_registered_environment(name: str) -> None:
    options = {"sweep": SMALL} if name.endswith("Sweep-v0") else {}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        env = gymnasium.make(name, render_mode="rgb_array", **options)
        check_env(env.unwrapped)
    unexpected = [
        str(warning.message)
        for warning in caught
        if not any(text in str(warning.message) for text in EXPECTED_WARNINGS)
    ]
    assert not unexpected


def test_what_make_gives_is_checked_as_it_flies() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with gymnasium.make("avoidbench/Sweep-v0", sweep=SMALL, render_mode="rgb_array") as env:
            observation, _ = env.reset(seed=1)
            ended = False
            while not ended:
                observation, _, terminated, truncated, info = env.step(to_goal(observation).astype(np.float32))
                ended = terminated or truncated
            assert info["outcome"] in ("collided", "timed_out", "reached_goal")
            picture = env.render()
            assert picture.shape == (12, 16, 3) and picture.dtype == np.uint8
            with pytest.raises(avoidbench.InputError, match="its episode has ended"):
                env.step(HOVER)


def test_make_vec_gives_the_vector() -> None:
    with closing(gymnasium.make_vec("avoidbench/Hall-v0", num_envs=2, threads=1, observe=["state"])) as env:
        assert isinstance(env.unwrapped, AvoidbenchVectorEnv)
        assert env.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
        assert env.reset()[0]["state"].shape == (2, 9)


@pytest.mark.parametrize("mode", list(AutoresetMode))
def test_a_vector_does_as_gymnasiums_own_vector_of_single_flights(mode: AutoresetMode) -> None:
    options: dict[str, Any] = {"observe": ["depth", "state", "goal", "pose"]}
    ours = AvoidbenchVectorEnv(ONE, 3, threads=2, autoreset_mode=mode, **options)
    theirs = SyncVectorEnv([lambda: AvoidbenchEnv(ONE, **options)] * 3, autoreset_mode=mode)
    assert ours.metadata["autoreset_mode"] is theirs.metadata["autoreset_mode"] is mode
    assert ours.observation_space == theirs.observation_space and ours.action_space == theirs.action_space
    assert same(ours.reset(seed=1), theirs.reset(seed=1))
    random = np.random.default_rng(3)
    ends = 0
    for step in range(70):
        actions = random.uniform(ours.action_space.low, ours.action_space.high).astype(np.float32)
        actions[0] = 0.0  # ends by the time
        got, wanted = ours.step(actions), theirs.step(actions)
        assert ours.observation_space.contains(got[0])
        for part in range(5):
            # Whatever order names were added in.
            assert same(got[part], wanted[part]), f"step {step}, part {part}"
        done = got[2] | got[3]
        ends += int(done.sum())
        if mode is AutoresetMode.DISABLED and done.any():
            with pytest.raises(avoidbench.InputError, match="its episode has ended: reset it"):
                ours.step(actions)
            # Theirs takes the mask out of the options.
            assert same(ours.reset(options={"reset_mask": done}), theirs.reset(options={"reset_mask": done}))
    assert ends > 5
    ours.close()
    theirs.close()


@pytest.mark.parametrize("mode", list(AutoresetMode))
def test_gymnasiums_wrappers_of_vectors(mode: AutoresetMode) -> None:
    plain = AvoidbenchVectorEnv(ONE, 2, threads=1, autoreset_mode=mode)
    env = RescaleAction(RecordEpisodeStatistics(plain), np.float32(-1.0), np.float32(1.0))
    assert env.single_action_space.contains(np.ones(4, np.float32))
    for _ in range(2):
        env.reset(seed=1)
        lengths = []
        for _ in range(65):
            _, _, terminated, truncated, infos = env.step(np.zeros((2, 4), np.float32))
            done = terminated | truncated
            if done.any():
                assert truncated.all() and not terminated.any()
                own = infos["final_info"] if mode is AutoresetMode.SAME_STEP else infos
                assert list(infos["episode"]["l"]) == list(own["steps"]) == [30, 30]
                assert infos["episode"]["r"] == pytest.approx(own["reward_sum"], abs=1e-9)
                lengths.append(30)
                if mode is AutoresetMode.DISABLED:
                    env.reset(options={"reset_mask": done})
        assert len(lengths) == 2
    env.close()


def test_statistics_of_a_single_flight() -> None:
    env = gymnasium.wrappers.RecordEpisodeStatistics(AvoidbenchEnv(ONE, observe=["goal"]))
    env.reset(seed=1)
    for _ in range(30):
        info = env.step(HOVER)[4]
    assert info["episode"]["l"] == info["steps"] == 30 and info["episode_index"] == 0


STEREO = {"preset": "stereo_sgm", "width_px": 64, "height_px": 48, "disparities": 16}
SENSORS: dict[str, dict[str, Any]] = {
    "depth_ideal": {"preset": "depth_ideal", "width_px": 16, "height_px": 12},
    "depth_noisy": {"preset": "depth_noisy", "width_px": 32, "height_px": 24},
    "stereo_sgm": STEREO,
    "more_mountings": {
        "preset": "depth_noisy",
        "width_px": 24,
        "height_px": 16,
        "more_mountings": [{"yaw_deg": 90}, {"yaw_deg": 180}],
    },
    "more_cameras": {
        "preset": "depth_ideal",
        "width_px": 16,
        "height_px": 12,
        "more_cameras": [
            {
                "preset": "depth_noisy",
                "width_px": 16,
                "height_px": 12,
                "yaw_deg": 90,
                "rate_hz": 10,
                "delay_ms": 120,
                "max_range_m": 30,
            }
        ],
    },
    "late": {"preset": "depth_ideal", "width_px": 16, "height_px": 12, "delay_ms": 200},
}


LIDARS = {"lidars": [{"preset": "velodyne_16", "rings": 4, "columns": 30}]}


@pytest.mark.parametrize("depth", ["inverse", "metric"])
@pytest.mark.parametrize("sensor", SENSORS)
def test_spaces_hold_all_that_is_seen(sensor: str, depth: str) -> None:
    sweep = {**SMALL, "sensor": {**SENSORS[sensor], **LIDARS}}
    with closing(AvoidbenchVectorEnv(sweep, 2, threads=1, observe=OBSERVATIONS, depth=depth)) as env:
        cameras = {"more_mountings": 3, "more_cameras": 2}.get(sensor, 1)
        assert env.single_observation_space["depth"].shape[0] == cameras
        observation, _ = env.reset(seed=2)
        assert env.observation_space.contains(observation)
        if sensor == "late":
            assert not observation["depth"].any(), "nothing is known before the first image"
        seen = set()
        for _ in range(40):
            observation = env.step(to_goal(observation))[0]
            assert env.observation_space.contains(observation)
            for name in OBSERVATIONS:
                assert np.isfinite(observation[name]).all()
                if observation[name].any():
                    seen.add(name)
        assert seen == set(OBSERVATIONS)
        assert observation["depth"].reshape(2, cameras, -1).any(axis=2).all(), "each camera saw something"


@pytest.mark.parametrize("name", OBSERVATIONS)
def test_each_observation_alone(name: str) -> None:
    sweep = changed(SMALL, sensor=LIDARS)
    env = AvoidbenchEnv(sweep, observe=[name])
    observation, _ = env.reset(seed=1)
    assert list(observation) == [name] and env.observation_space.contains(observation)
    both = AvoidbenchEnv(sweep, observe=[*OBSERVATIONS][::-1])
    both.reset(seed=1)
    for _ in range(4):
        alone, all_of_it = env.step(HOVER)[0], both.step(HOVER)[0]
        assert env.observation_space.contains(alone)
        assert same(alone[name], all_of_it[name]), "what else is observed changes nothing"


def test_metric_and_inverse_depth_are_of_the_same_pictures() -> None:
    metric, inverse = (AvoidbenchEnv(SMALL, depth=word).reset(seed=1)[0]["depth"] for word in ("metric", "inverse"))
    near = metric < 15.0
    assert near.any() and (metric > 0.0).all()
    assert np.allclose(inverse, 0.1 / metric, rtol=1e-6) and (metric[~near] == 15.0).all()


@pytest.mark.parametrize("frame", ["heading", "world"])
@pytest.mark.parametrize("action", ["velocity", "acceleration", "rates_thrust", "trajectory"])
def test_each_kind_of_action_flies_upward(action: str, frame: str) -> None:
    options: dict[str, Any] = {"trajectory_points": 4, "trajectory_horizon_s": 0.8}
    env = AvoidbenchEnv(SMALL, action=action, frame=frame, observe=["pose"], **options)
    assert env.action_space.shape == ((16,) if action == "trajectory" else (4,))
    upward = {
        "velocity": [0, 0, 1, 0],
        "acceleration": [0, 0, 1.5, 0],
        "rates_thrust": [0, 0, 0, 11.0],
        "trajectory": [number for i in range(1, 5) for number in (0, 0, 0.2 * i, 0)],
    }[action]
    start, _ = env.reset(seed=1)
    assert env.action_space.contains(np.array(upward, np.float32))
    for _ in range(15):
        observation, _, terminated, truncated, _ = env.step(upward)
        assert not terminated and not truncated
    moved = observation["pose"] - start["pose"]
    assert moved[3] > 0.05 and abs(moved[1]) < 0.02 and abs(moved[2]) < 0.02


def test_heading_and_world_are_the_frames_they_say() -> None:
    for frame in ("heading", "world"):
        env = AvoidbenchEnv(SMALL, frame=frame, observe=["pose", "state"])
        start, _ = env.reset(seed=1)
        yaw = 2.0 * np.arctan2(start["pose"][10], start["pose"][7])
        for _ in range(20):
            observation = env.step([1.0, 0.0, 0.0, 0.0])[0]
        moved = (observation["pose"] - start["pose"])[1:3]
        wanted = [np.cos(yaw), np.sin(yaw)] if frame == "heading" else [1.0, 0.0]
        assert np.allclose(moved / np.linalg.norm(moved), wanted, atol=5e-3), frame
        assert abs(np.sin(yaw)) > 0.1, "or the frames are the same"


def test_rewards_none_weights_and_functions() -> None:
    def flown(reward: Any) -> tuple[np.ndarray, list[Any]]:
        env = AvoidbenchVectorEnv(ONE, 2, threads=1, reward=reward)
        env.reset(seed=1)
        steps = [env.step(np.tile([1.0, 0.0, 0.0, 0.0], (2, 1))) for _ in range(62)]
        return np.array([step[1] for step in steps]), [step[4] for step in steps]

    none, _ = flown(None)
    assert not none.any()
    default, infos = flown(Reward())
    assert default[10:29].min() > 0.0 and not default[30].any(), "progress; the step that begins an episode has none"
    assert infos[29]["reward_sum"] == pytest.approx(default[:30].sum(axis=0))
    time_only, _ = flown(Reward(0.0, 0.3, 0.0, 0.0))
    assert np.allclose(time_only[:30], -0.01)

    seen: list[tuple[Any, ...]] = []

    def twice(
        observation: dict[str, np.ndarray],
        actions: np.ndarray,
        reward: np.ndarray,
        terminated: np.ndarray,
        truncated: np.ndarray,
    ) -> np.ndarray:
        seen.append((actions.shape, observation["goal"].shape, terminated.dtype, truncated.copy()))
        return 2.0 * reward + 1.0

    own, infos = flown(twice)
    began = np.zeros(62, bool)
    began[[30, 61]] = True
    assert np.allclose(own[~began], 2.0 * default[~began] + 1.0) and not own[began].any()
    assert infos[29]["reward_sum"] == pytest.approx(own[:30].sum(axis=0)), "the sum is of what the function gave"
    assert infos[60]["reward_sum"] == pytest.approx(own[31:61].sum(axis=0))
    assert seen[0][:3] == ((2, 4), (2, 3), np.dtype(bool)) and seen[29][3].all()


def test_in_turn_each_trial_is_flown_once() -> None:
    with closing(
        AvoidbenchVectorEnv(
            changed(SMALL, mission={"time_limit_s": 1}), 2, threads=2, observe=["goal"], order="in_turn"
        )
    ) as env:
        assert env.trial_count == 4
        env.reset(seed=1)
        flown = []
        while len(flown) < 8:
            infos = env.step(np.zeros((2, 4)))[4]
            if infos:
                flown += list(
                    zip(infos["map_seed"].tolist(), infos["mission_index"].tolist(), infos["trial_key"], strict=True)
                )
    assert {trial[:2] for trial in flown[:4]} == {(1, 0), (1, 1), (2, 0), (2, 1)}
    assert len({trial[2] for trial in flown[:4]}) == 4 and flown[4:] == flown[:4]


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
@pytest.mark.parametrize("slots", [2, 3, 15])
def test_in_turn_the_ends_of_round_0_are_each_trial_that_can_be_flown_once(
    slots: int, mode: AutoresetMode, tmp_path: Path
) -> None:
    # So wide that some missions have no free start or goal.
    sweep = changed(SMALL, maps={"seeds": [1, 2, 3, 4, 5, 6]}, mission={"time_limit_s": 1, "free_radius_m": 1.7})
    missions = fly({**sweep, "planners": ["straight_line"]}, tmp_path / "flown.db").missions
    valid = missions[missions["is_valid"] == 1]
    assert 2 < len(valid) < len(missions) == 12
    flown = []
    with closing(
        AvoidbenchVectorEnv(sweep, slots, threads=2, observe=["goal"], order="in_turn", autoreset_mode=mode)
    ) as env:
        env.reset()
        while (env.rounds == 0).any():
            infos = env.step(np.zeros((slots, 4)))[4]
            ends = infos.get("final_info", infos)
            for slot in np.flatnonzero(ends.get("_outcome", [])):
                if ends["round"][slot] == 0:
                    flown.append((int(ends["map_seed"][slot]), int(ends["mission_index"][slot])))
    assert sorted(flown) == sorted(zip(valid["map_seed"], valid["mission_index"], strict=True))


def test_the_greatest_map_seed_is_told() -> None:
    sweep = changed(ONE, maps={"seeds": [2**64 - 1]})
    with closing(AvoidbenchVectorEnv(sweep, 2, threads=1, observe=["goal"])) as env:
        env.reset()
        for _ in range(30):
            infos = env.step(np.zeros((2, 4)))[4]
    assert infos["map_seed"].tolist() == [2**64 - 1] * 2


def test_a_vector_that_does_not_copy_gives_the_same_arrays() -> None:
    with closing(AvoidbenchVectorEnv(ONE, 2, threads=1, copy=False)) as env:
        first, _ = env.reset(seed=1)
        before = copy.deepcopy(first)
        later = env.step(np.tile([1.0, 0.0, 0.0, 0.0], (2, 1)))[0]
        assert all(later[name] is first[name] for name in first)
        assert not same(before, later)
    with closing(AvoidbenchVectorEnv(ONE, 2, threads=1)) as env:
        kept, _ = env.reset(seed=1)
        env.step(np.tile([1.0, 0.0, 0.0, 0.0], (2, 1)))
        assert same(kept, before)


def straight_line(mission: Any, max_speed_mps: float, braking_mps2: float) -> Callable[[np.ndarray], np.ndarray]:
    """What the planner straight_line commands, but for its yaw: that of the start, which a yaw rate of 0 keeps."""
    start, goal = (mission[[f"{place}_{axis}_m" for axis in "xyz"]].to_numpy(float) for place in ("start", "goal"))
    course = (goal - start) / np.linalg.norm(goal - start)

    def command(pose: np.ndarray) -> np.ndarray:
        left_m = float((goal - pose[1:4]) @ course)
        speed_mps = min(max_speed_mps, np.sqrt(2.0 * braking_mps2 * abs(left_m)), 2.0 * abs(left_m))
        aside_m = goal - left_m * course - pose[1:4]
        return np.array([*(np.copysign(speed_mps, left_m) * course + aside_m), 0.0])

    return command


def test_episodes_end_as_the_programs_trials(tmp_path: Path) -> None:
    sweep = changed(
        SMALL,
        maps={"poisson_radius_m": 4.5},
        trials=3,
        planners=["straight_line"],
        max_speed_mps=2.0,
        mission={"time_limit_s": 20},
    )
    results = fly(sweep, tmp_path / "flown.db")
    trials = results.trials.set_index(["map_seed", "mission_index"])
    missions = results.missions.set_index(["map_seed", "mission_index"])
    env = AvoidbenchEnv(sweep, observe=["pose"], frame="world", order="in_turn")
    assert env.trial_count == len(trials) == 6
    outcomes, flown = set(), set()
    for identity in sorted(trials.index):
        observation, _ = env.reset()
        command = straight_line(missions.loc[identity], 2.0, 0.3 * 6.0)
        info: dict[str, Any] = {}
        while not info:
            observation, _, _, _, info = env.step(command(observation["pose"]))
        assert (info["map_seed"], info["mission_index"]) == identity
        wanted = trials.loc[identity]
        assert info["outcome"] == wanted["outcome"]
        assert info["end_time_s"] == pytest.approx(wanted["end_time_s"], abs=0.002)
        for name, value in info["metrics"].items():
            if name.startswith(("processing", "deadline")):
                assert np.isnan(value), f"{name}: nobody measured the policy"
            elif name in wanted:
                assert value == pytest.approx(wanted[name], rel=1e-3, abs=1e-3, nan_ok=True), name
        outcomes.add(info["outcome"])
        flown.add(identity)
    assert len(flown) == 6 and outcomes == {"collided", "reached_goal"}
