"""Gymnasium environments: flights that a learner steps. Episodes are trials of a sweep, with the same metrics."""

from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from avoidbench._extension import InputError
from avoidbench.flights import (
    DEFAULT_REWARD,
    OBSERVATIONS,
    Flights,
    Observation,
    Reward,
    RewardFunction,
    Sweep,
    observed,
    real_array,
    seed_of,
    seen_from_above,
    whole,
)


class AvoidbenchVectorEnv(gymnasium.vector.VectorEnv[Observation, NDArray[Any], NDArray[Any]]):
    """N flights that a pool of threads steps together.

    The same sweep, seed and actions give the same bytes, for any number of threads. The next trial of a slot
    depends on the seed, the slot and the number of the episode.

    Args:
        sweep: a sweep file, the name of a built-in sweep, or a dict with the contents of a sweep file (`planners` may
            be left out). Episodes are drawn from the trials of its axes and missions.
        num_envs: N.
        threads: default: one per processor.
        set: changes to the sweep, as the program's `--set`: {"maps.poisson_radius_m": 4.5}.
        observe: names of OBSERVATIONS to return; all use the vehicle's own state estimate, in SI units:
            depth (N, C, H, W) float32 of C cameras: see `depth`; state (N, 9) float32: velocity in the heading frame (x
            where the nose points, level; y left; z up), the world's up in the body frame, body rates; goal (N, 3)
            float32: from the vehicle to the goal in the heading frame; pose (N, 14) float64: time, position and
            velocity in the world frame, q_world_body (w, x, y, z), body rates; imu (N, K, 7) float32: time, rates,
            specific force of the samples since the last step, newest last, zeros before; stereo (N, C, 2, H, W) uint8,
            grey, left and right; color (N, C, H, W, 3) uint8, RGB; points (N, L, S, 3) float32 of L lidars: the point
            that each of the S shots of a sweep met, in the lidar's frame (x forward, y left, z up; that of the sweep's
            end if it de-skews), metres, zeros without a return or a sweep yet; ranges (N, L, S) float32: the distance
            of that point, see `depth`. Images and sweeps are the newest ones; at an episode's end they are from its
            last moments.
        depth: of depth and ranges. "metric": metres, the greatest range if nothing returns; "inverse": the least
            range over that. In both, 0 means unknown: nearer than the least range, not matched by stereo, no image or
            sweep yet. A lidar's shot without a return has the greatest range, for whatever reason.
        depth_dtype: of depth: "float32", or "uint8": 0 is unknown, else (byte - 1) / 254 is the inverse depth, or the
            share of the greatest range, `depth_greatest_m`, if depth is "metric"; rounded to the nearest byte.
        action: "velocity" (vx, vy, vz, yaw rate), "acceleration" (ax, ay, az, yaw rate), "rates_thrust" (body rates,
            thrust over mass: 9.81 hovers), or "trajectory" (for each of `trajectory_points` x, y, z and yaw, from the
            vehicle's present place and heading, evenly spaced over `trajectory_horizon_s`). They take effect after the
            sweep's latency.
        unit_actions: True: -1 … 1 stands for the least … greatest value that each number otherwise has in action_space
            (for thrust 0 … that of all rotors), linearly and also beyond. False: SI units.
        frame: of velocities, accelerations and trajectories: "heading" or "world".
        reward: a Reward; a function of (observation, actions, default reward, terminated, truncated), arrays over N,
            actions in SI units, that returns (N,); or None for zeros. It must return finite values; if it raises, the
            step has been flown nevertheless.
        order: "random", or "in_turn": slot s flies the trials s, s + N, … of the sweep, then begins again: see
            `rounds`. Missions that can't be flown are skipped.
        seed: of the first reset() without a seed.
        autoreset_mode: Gymnasium's. NEXT_STEP: the step after an end begins the next episode, without a reward.
            SAME_STEP: an end gives the first observation of the next episode, the last one is in infos["final_obs"].
            DISABLED: reset(options={"reset_mask": …}).
        copy: whether each call returns new arrays, or the same ones, which the next call overwrites.
        kept_maps: maps kept in memory in addition to those in use.
        policy: the planner's label in trial keys.

    infos of an episode's end (with Gymnasium's masks, "_outcome" and so on): outcome, reason, trial_key, map_seed,
    mission_index, episode_index, round (see `rounds`), end_time_s, steps, reward_sum (of what reward gave), and in
    "metrics" each metric of `avoidbench metrics`, NaN where it is undefined.

    Raises InputError, a ValueError, with file, line and column for errors in a sweep; TypeError and ValueError
    otherwise."""

    def __init__(
        self,
        sweep: Sweep,
        num_envs: int = 1,
        *,
        threads: int | None = None,
        set: Mapping[str, Any] | None = None,
        observe: Sequence[str] = ("depth", "state", "goal"),
        depth: str = "inverse",
        depth_dtype: str = "float32",
        action: str = "velocity",
        unit_actions: bool = False,
        frame: str = "heading",
        trajectory_points: int = 10,
        trajectory_horizon_s: float = 1.0,
        reward: Reward | RewardFunction | None = DEFAULT_REWARD,
        order: str = "random",
        seed: int = 1,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        copy: bool = True,
        kept_maps: int = 16,
        policy: str = "policy",
        render_mode: str | None = None,
    ) -> None:
        if render_mode is not None:
            raise ValueError("render_mode: only AvoidbenchEnv draws, not a vector of flights")
        self.num_envs = whole(num_envs, "num_envs", 1, 65536)
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.copy = copy
        self._flights: Flights | None = Flights(
            sweep,
            self.num_envs,
            threads,
            set,
            observe,
            depth,
            depth_dtype,
            action,
            unit_actions,
            frame,
            trajectory_points,
            trajectory_horizon_s,
            reward,
            order,
            seed,
            kept_maps,
            policy,
        )
        self.metadata = {"autoreset_mode": self.autoreset_mode, "render_modes": []}
        self.single_observation_space = self._flights.observation_space
        self.single_action_space = self._flights.action_space
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.step_s = self._flights.step_s
        """Simulated seconds between two observations."""
        self.trial_count = self._flights.trial_count
        """Number of trials of the sweep."""
        self.depth_greatest_m = self._flights.depth_greatest_m
        """Greatest range of the cameras, metres; NaN if depth is not observed."""

    def _open(self) -> Flights:
        if self._flights is None:
            raise gymnasium.error.ClosedEnvironmentError("the environment is closed: make another one")
        return self._flights

    @property
    def rounds(self) -> NDArray[np.int64]:
        """(N,): in order "in_turn", how often each slot has flown its trials before the one that it flies now;
        infos["round"] has it of an end. The episodes of round 0 are each trial that can be flown, once: a slot without
        a trial of its own begins with round 1. In random order 0."""
        return np.array(self._open().core.rounds(), np.int64)

    def _seen(self) -> Observation:
        views = self._open().views
        return {name: array.copy() for name, array in views.items()} if self.copy else dict(views)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode in each slot, or in those of options["reset_mask"], (N,) bool.

        seed: the trials begin again, as this seed chooses them; a whole number, for all slots."""
        flights = self._open()
        if isinstance(seed, list):
            raise TypeError("seed: expected one number for all slots, which gives each slot its own trials")
        mask: NDArray[np.bool_] | None = None
        for name in options or {}:
            if name != "reset_mask":
                raise ValueError(f"options: {name!r} is not an option; there is only 'reset_mask'")
        if options and options["reset_mask"] is not None:
            array = np.asarray(options["reset_mask"])
            if array.shape != (self.num_envs,) or array.dtype != np.bool_:
                raise ValueError(
                    f"options['reset_mask']: expected bool of shape ({self.num_envs},), got {array.dtype} {array.shape}"
                )
            if not array.any():
                raise ValueError("options['reset_mask']: expected at least one slot")
            mask = array
        flights.reset(seed_of(seed), mask)
        return self._seen(), {}

    def step(
        self, actions: NDArray[Any]
    ) -> tuple[Observation, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Flies each slot to its next observation, 1 / rates.plan_hz later. `actions`: (N, width).

        Gives observations, rewards (N,) float64, terminated (N,) bool (goal, crash), truncated (N,) bool (time limit),
        infos."""
        flights = self._open()
        flights.step(actions, self.autoreset_mode == AutoresetMode.NEXT_STEP)
        rewards, terminated, truncated = flights.rewards.copy(), flights.terminated, flights.truncated
        ended = flights.ended()
        infos: dict[str, Any] = {}
        same_step = self.autoreset_mode == AutoresetMode.SAME_STEP
        for end in ended:
            slot = end.pop("slot")
            if same_step:
                last = {name: array[slot].copy() for name, array in flights.views.items()}
                infos = self._add_info(infos, {"final_obs": last, "final_info": end}, slot)
            else:
                infos = self._add_info(infos, end, slot)
        if same_step and ended:
            flights.reset(None, terminated | truncated)
        return self._seen(), rewards, terminated, truncated, infos

    def close_extras(self, **kwargs: Any) -> None:
        """Ends threads and frees maps."""
        self._flights = None


class AvoidbenchEnv(gymnasium.Env[Observation, NDArray[Any]]):
    """One flight that is stepped; call reset() after an end. See AvoidbenchVectorEnv, whose arguments and infos it
    has; its arrays have no axis N. With render_mode="rgb_array" render() gives the depth as a grey picture
    (H, W, 3) uint8, near is bright; or, where no depth is observed, the first lidar's sweep from above, (200, 200, 3),
    10 pixels a metre, forward is up."""

    metadata = {"render_modes": ["rgb_array"], "render_fps": 30}

    def __init__(
        self,
        sweep: Sweep,
        *,
        set: Mapping[str, Any] | None = None,
        observe: Sequence[str] = ("depth", "state", "goal"),
        depth: str = "inverse",
        depth_dtype: str = "float32",
        action: str = "velocity",
        unit_actions: bool = False,
        frame: str = "heading",
        trajectory_points: int = 10,
        trajectory_horizon_s: float = 1.0,
        reward: Reward | RewardFunction | None = DEFAULT_REWARD,
        order: str = "random",
        seed: int = 1,
        kept_maps: int = 16,
        policy: str = "policy",
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode: expected 'rgb_array' or None, got {render_mode!r}")
        if render_mode is not None and not {"depth", "points", "ranges"} & {*observed(observe)}:
            raise ValueError("render_mode: pictures show depth, points or ranges, and none of these is observed")
        self.render_mode = render_mode
        self._depth = depth
        self._flights: Flights | None = Flights(
            sweep,
            1,
            1,
            set,
            observe,
            depth,
            depth_dtype,
            action,
            unit_actions,
            frame,
            trajectory_points,
            trajectory_horizon_s,
            reward,
            order,
            seed,
            kept_maps,
            policy,
        )
        self.observation_space = self._flights.observation_space  # type: ignore[assignment]
        self.action_space = self._flights.action_space
        self.step_s = self._flights.step_s
        """Simulated seconds between two observations."""
        self.trial_count = self._flights.trial_count
        """Number of trials of the sweep."""
        self.depth_greatest_m = self._flights.depth_greatest_m
        """Greatest range of the cameras, metres; NaN if depth is not observed."""
        self.metadata = {**self.metadata, "render_fps": round(1.0 / self.step_s)}

    def _open(self) -> Flights:
        if self._flights is None:
            raise gymnasium.error.ClosedEnvironmentError("the environment is closed: make another one")
        return self._flights

    def _seen(self) -> Observation:
        return {name: array[0].copy() for name, array in self._open().views.items()}

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begins the next episode, or with a seed the first one that this seed chooses. There are no options."""
        seed = seed_of(seed)
        super().reset(seed=seed)
        if options:
            raise ValueError(f"options: {next(iter(options))!r} is not an option; there are none")
        self._open().reset(seed, None)
        return self._seen(), {}

    def step(self, action: NDArray[Any]) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Flies to the next observation, 1 / rates.plan_hz later. `action`: (width,).

        Gives the observation, the reward, terminated (goal, crash), truncated (time limit) and infos."""
        flights = self._open()
        array = real_array(action, self.action_space.shape or (), "action")
        flights.step(array[np.newaxis], False)
        info: dict[str, Any] = {}
        for end in flights.ended():
            end.pop("slot")
            info = end
        return self._seen(), float(flights.rewards[0]), bool(flights.terminated[0]), bool(flights.truncated[0]), info

    @property
    def round(self) -> int:
        """In order "in_turn", how often the trials have been flown before the one that flies now: as
        AvoidbenchVectorEnv.rounds."""
        return int(self._open().core.rounds()[0])

    def render(self) -> NDArray[np.uint8] | None:
        """The newest depth, near is bright, the cameras side by side; without it the first lidar's newest sweep from
        above. None without a render_mode."""
        flights = self._open()
        if self.render_mode is None:
            return None
        if "depth" not in flights.views and flights.drawn is not None:
            return seen_from_above(flights.drawn[0, 0])
        assert flights.depth is not None
        depth = np.concatenate(list(flights.depth[0]), axis=1)
        near = depth / flights.depth_greatest
        bright = np.sqrt(near) if self._depth == "inverse" else np.where(depth > 0.0, 1.0 - near, 0.0)
        return np.repeat(np.round(255.0 * bright).astype(np.uint8)[..., np.newaxis], 3, axis=2)

    def close(self) -> None:
        """Ends threads and frees maps."""
        self._flights = None


__all__ = ["OBSERVATIONS", "AvoidbenchEnv", "AvoidbenchVectorEnv", "InputError", "Reward"]
