"""The adapter keeps the rules of Stable-Baselines3, and PPO runs on it; where that is installed."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from avoidbench.env import AvoidbenchVectorEnv
from flights import ONE, SMALL, to_goal

# importorskip() would leave a file without tests, which pytest reports as a failure.
try:
    from avoidbench.sb3 import Sb3VecEnv
    from stable_baselines3 import PPO
    from stable_baselines3.common.vec_env import VecEnv, VecMonitor, VecNormalize
except ImportError:
    pytestmark = pytest.mark.skip("Stable-Baselines3 is not installed")

SAME: dict[str, Any] = {"threads": 1, "autoreset_mode": "SameStep"}


def test_steps_are_those_of_the_vector() -> None:
    ours, plain = Sb3VecEnv(AvoidbenchVectorEnv(SMALL, 3, **SAME)), AvoidbenchVectorEnv(SMALL, 3, **SAME)
    assert isinstance(ours, VecEnv) and ours.num_envs == 3
    assert ours.observation_space == plain.single_observation_space
    assert ours.action_space == plain.single_action_space
    ours.seed(7)
    seen, (wanted, _) = ours.reset(), plain.reset(seed=7)
    outcomes, limits = set(), 0
    for _ in range(200):
        assert all((seen[name] == wanted[name]).all() for name in wanted)
        actions = to_goal(wanted)
        actions[2] = 0.0  # hovers until the time is up
        seen, rewards, dones, infos = ours.step(actions)
        wanted, wanted_rewards, terminated, truncated, all_infos = plain.step(actions)
        assert rewards.dtype == np.float32 and np.allclose(rewards, wanted_rewards)
        assert dones.dtype == bool and (dones == (terminated | truncated)).all()
        assert [bool(info) for info in infos] == dones.tolist()
        for slot in np.flatnonzero(dones):
            info, last = infos[slot], all_infos["final_obs"][slot]
            assert info["terminal_observation"].keys() == last.keys()
            assert all((info["terminal_observation"][name] == last[name]).all() for name in last)
            assert info["TimeLimit.truncated"] == (info["outcome"] == "timed_out") == truncated[slot]
            assert info["is_success"] == (info["outcome"] == "reached_goal")
            end = all_infos["final_info"]
            assert info["episode"]["l"] == end["steps"][slot] and info["episode"]["t"] == end["end_time_s"][slot]
            assert info["episode"]["r"] == end["reward_sum"][slot] == info["reward_sum"]
            assert info["metrics"]["path_length_m"] == end["metrics"]["path_length_m"][slot]
            assert not any(name.startswith("_") for name in (*info, *info["metrics"]))
            outcomes.add(info["outcome"])
            limits += info["TimeLimit.truncated"]
    assert limits >= 2 and len(outcomes) >= 2
    ours.reset()
    ours.close()
    plain.close()


def test_attributes_and_what_slots_lack() -> None:
    envs = Sb3VecEnv(AvoidbenchVectorEnv(ONE, 2, **SAME))
    assert envs.get_attr("trial_count") == [1, 1] and envs.get_attr("step_s", 1) == [pytest.approx(1 / 30)]
    assert envs.env_is_wrapped(VecMonitor) == [False, False]
    with pytest.raises(NotImplementedError):
        envs.set_attr("step_s", 1.0)
    with pytest.raises(NotImplementedError):
        envs.env_method("render")
    with pytest.raises(ValueError, match="autoreset_mode: expected 'SameStep', got 'NextStep'"):
        Sb3VecEnv(AvoidbenchVectorEnv(ONE, 2))


def test_wrappers_of_stable_baselines3_agree() -> None:
    envs = VecMonitor(Sb3VecEnv(AvoidbenchVectorEnv(ONE, 2, **SAME)))
    envs = VecNormalize(envs, norm_obs_keys=["state"])
    envs.reset()
    for _ in range(30):
        _, _, dones, infos = envs.step(np.zeros((2, 4), np.float32))
    assert dones.all()
    for info in infos:
        assert info["episode"]["l"] == info["steps"] == 30
        assert info["episode"]["r"] == pytest.approx(info["reward_sum"], abs=1e-4)


def test_ppo_runs_with_images_and_unit_actions() -> None:
    sweep = {**SMALL, "sensor": {"preset": "depth_ideal", "width_px": 48, "height_px": 36}, "rates": {"plan_hz": 10}}
    envs = Sb3VecEnv(AvoidbenchVectorEnv(sweep, 8, **SAME, unit_actions=True, depth_dtype="uint8"))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of PyTorch
        model = PPO("MultiInputPolicy", envs, n_steps=64, batch_size=128, n_epochs=2, seed=1, device="cpu")
        model.learn(2048)
    assert model.num_timesteps == 2048
    assert len(model.ep_info_buffer) > 5 and len(model.ep_success_buffer) > 5
    image = model.policy.features_extractor.extractors["depth"]
    assert type(image).__name__ == "NatureCNN", "bytes are taken as an image"
    action, _ = model.predict(envs.reset(), deterministic=True)
    assert action.shape == (8, 4) and (np.abs(action) <= 1.0).all()
    envs.close()
