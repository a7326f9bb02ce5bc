"""Gymnasium environments: flights that a learner steps. Episodes are trials of a sweep, with the same metrics."""

import difflib
import math
import operator
import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, SupportsIndex

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from avoidbench._extension import InputError
from avoidbench._extension import core as _core
from avoidbench._input import plain_places
from avoidbench._text import overrides, plain_text, yaml_text

Observation = dict[str, NDArray[Any]]
Sweep = str | os.PathLike[str] | Mapping[str, Any]
RewardFunction = Callable[
    [Observation, NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_]], ArrayLike
]

OBSERVATIONS = ("depth", "state", "goal", "pose", "imu", "stereo", "color", "points", "ranges")
_MOST_SEED = 2**64 - 1
_DTYPES: dict[str, Any] = {"stereo": np.uint8, "color": np.uint8, "pose": np.float64}


@dataclass(frozen=True)
class Reward:
    """The reward of a step: progress, less time, and a term for the end."""

    progress_per_m: float = 1.0
    """For each metre gained along the mission's shortest free path."""
    time_per_s: float = 0.1
    """Subtracted for each simulated second."""
    crash: float = 10.0
    """Subtracted if the flight ends collided or out of the map."""
    goal: float = 10.0
    """Added if the goal is reached."""


def _whole(value: SupportsIndex, name: str, lowest: int, highest: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: expected a whole number, got {type(value).__name__}") from None
    if not lowest <= number <= highest:
        raise ValueError(f"{name}: expected {lowest} … {highest}, got {number}")
    return number


def _real(value: Any, name: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{name}: expected a number, got {type(value).__name__}")
    if not math.isfinite(value):
        raise ValueError(f"{name}: {value} is not finite")
    return float(value)


def _observed(observe: Sequence[str]) -> tuple[str, ...]:
    if isinstance(observe, str):
        raise TypeError(f"observe: expected a list of names, got the text {observe!r}")
    names = tuple(observe)
    for name in names:
        if name not in OBSERVATIONS:
            alike = difflib.get_close_matches(str(name), OBSERVATIONS, 1)
            hint = f" (did you mean {alike[0]}?)" if alike else ""
            raise ValueError(f"observe: {name!r} is not one of {', '.join(OBSERVATIONS)}{hint}")
    if not names or len(set(names)) != len(names):
        raise ValueError("observe: expected at least one name, and each only once")
    return names


def _view_space(name: str, shape: Mapping[str, Any], depth: str) -> gymnasium.spaces.Box:
    """Of one flight."""
    cameras, height, width = shape["cameras"], shape["height_px"], shape["width_px"]
    if name == "depth":
        return gymnasium.spaces.Box(
            0.0, 1.0 if depth == "inverse" else shape["max_range_m"], (cameras, height, width), np.float32
        )
    if name == "stereo":
        return gymnasium.spaces.Box(0, 255, (cameras, 2, height, width), np.uint8)
    if name == "color":
        return gymnasium.spaces.Box(0, 255, (cameras, height, width, 3), np.uint8)
    shots = (shape["lidars"], shape["lidar_shots"])
    if name == "ranges":
        return gymnasium.spaces.Box(0.0, 1.0 if depth == "inverse" else shape["lidar_max_range_m"], shots, np.float32)
    if name == "points":
        return gymnasium.spaces.Box(-np.inf, np.inf, (*shots, 3), np.float32)
    sizes: dict[str, tuple[int, ...]] = {"state": (9,), "goal": (3,), "pose": (14,), "imu": (shape["imu_samples"], 7)}
    return gymnasium.spaces.Box(-np.inf, np.inf, sizes[name], _DTYPES.get(name, np.float32))


def _seen_from_above(points: NDArray[np.float32]) -> NDArray[np.uint8]:
    """A grey picture (200, 200, 3) of a sweep (S, 3): its lidar in the middle, x up, y to the left, 10 pixels a metre;
    what is within 1 m above and below is white, else it is grey."""
    met = points[points.any(axis=1)]
    rows, columns = np.round(100.0 - 10.0 * met[:, :2].astype(np.float64)).astype(np.int64).T
    shown = (rows >= 0) & (rows < 200) & (columns >= 0) & (columns < 200)
    picture = np.zeros((200, 200), np.uint8)
    np.maximum.at(picture, (rows[shown], columns[shown]), np.where(np.abs(met[shown, 2]) < 1.0, 255, 90))
    return np.repeat(picture[..., np.newaxis], 3, axis=2)


def _array(actions: ArrayLike, wanted: tuple[int, ...], name: str) -> NDArray[Any]:
    """`actions` as an array, if it has this shape and is of real numbers."""
    try:
        array = np.asarray(actions)
    except ValueError as error:
        raise ValueError(f"{name}: expected an array of shape {wanted}: {error}") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: expected real numbers, got {array.dtype}")
    if array.shape != wanted:
        raise ValueError(f"{name}: expected an array of shape {wanted}, got {array.shape}")
    return array


class _Flights:
    """The flights of an environment, their arrays and spaces."""

    def __init__(
        self,
        sweep: Sweep,
        slots: int,
        threads: int | None,
        set: Mapping[str, Any] | None,
        observe: Sequence[str],
        depth: str,
        action: str,
        frame: str,
        trajectory_points: SupportsIndex,
        trajectory_horizon_s: float,
        reward: Reward | RewardFunction | None,
        order: str,
        seed: SupportsIndex,
        kept_maps: SupportsIndex,
        policy: str,
    ) -> None:
        self.observe, self.slots = _observed(observe), slots
        for name, word in (
            ("depth", depth),
            ("action", action),
            ("frame", frame),
            ("order", order),
            ("policy", policy),
        ):
            if not isinstance(word, str):
                raise TypeError(f"{name}: expected a word, got {type(word).__name__}")
        if reward is not None and not isinstance(reward, Reward) and not callable(reward):
            raise TypeError(f"reward: expected a Reward, a function or None, got {type(reward).__name__}")
        self.reward_function = reward if callable(reward) else None
        weights = reward if isinstance(reward, Reward) else Reward(0.0, 0.0, 0.0, 0.0) if reward is None else Reward()
        options = {
            "observe": list(self.observe),
            "depth": depth,
            "action": action,
            "frame": frame,
            "order": order,
            "policy": plain_text(policy, "policy"),
            "slots": slots,
            "threads": _whole(_default_threads() if threads is None else threads, "threads", 1, 1024),
            "seed": _whole(seed, "seed", 0, _MOST_SEED),
            "kept_maps": _whole(kept_maps, "kept_maps", 1, 10**6),
            "trajectory_points": _whole(trajectory_points, "trajectory_points", 1, 1000),
            "trajectory_horizon_s": _real(trajectory_horizon_s, "trajectory_horizon_s"),
            **{name: _real(value, f"reward.{name}") for name, value in asdict(weights).items()},
        }
        given, text = _sweep_text(sweep)
        with plain_places(given if text is not None else None):
            self.core = _core.SteppedFlights(given, text, overrides(set or {}), options)
        for warning in self.core.warnings:
            warnings.warn(warning, stacklevel=4)
        shape = self.core.shape()
        self.step_s: float = shape["step_s"]
        self.trial_count: int = shape["trial_count"]
        self.action_space = gymnasium.spaces.Box(
            np.array(shape["action_lowest"], np.float32), np.array(shape["action_highest"], np.float32)
        )
        self.observation_space = gymnasium.spaces.Dict({name: _view_space(name, shape, depth) for name in self.observe})
        self.views: Observation = {name: self._view(name, self.observation_space[name]) for name in self.observe}
        # What render() draws: points, also where only their ranges are observed.
        self.drawn: NDArray[Any] | None = self.views.get("points")
        if self.drawn is None and "ranges" in self.observe:
            self.drawn = self._view("points", _view_space("points", shape, depth))
        self.rewards = np.zeros(slots)
        self._own_sums = np.zeros(slots)  # of the reward function, over the episode
        self._ends = np.zeros((2, slots), np.uint8)
        self.core.write_results(self.rewards, self._ends[0], self._ends[1])

    def _view(self, name: str, space: gymnasium.Space[Any]) -> NDArray[Any]:
        """The array that this observation is written to from now on."""
        array: NDArray[Any] = np.zeros((self.slots, *(space.shape or ())), space.dtype)
        self.core.write_view(name, array)
        return array

    @property
    def terminated(self) -> NDArray[np.bool_]:
        return np.asarray(self._ends[0] != 0)

    @property
    def truncated(self) -> NDArray[np.bool_]:
        return np.asarray(self._ends[1] != 0)

    def step(self, actions: ArrayLike, begins_next: bool) -> None:
        """`actions`: (slots, width)."""
        array = _array(actions, (self.slots, *(self.action_space.shape or ())), "actions")
        numbers = np.ascontiguousarray(array, np.float64)
        before = self.terminated | self.truncated
        self._own_sums[before] = 0.0
        self.core.step(numbers, begins_next)
        if self.reward_function is not None:
            own = np.asarray(
                self.reward_function(self.views, numbers, self.rewards.copy(), self.terminated, self.truncated)
            )
            if own.dtype.kind not in "fiub":
                raise TypeError(f"reward: expected real numbers from the function, got {own.dtype}")
            if own.shape != (self.slots,):
                raise ValueError(
                    f"reward: expected an array of shape ({self.slots},) from the function, got {own.shape}"
                )
            if not np.isfinite(own).all():
                raise ValueError(f"reward: the function gave {own[~np.isfinite(own)][0]}, which is not finite")
            self.rewards[:] = np.where(before, 0.0, own)  # the first observation of an episode has no reward
            self._own_sums += self.rewards

    def __reduce__(self) -> str:
        raise TypeError("an environment can't be copied or pickled: make another one with the same arguments")

    def reset(self, seed: int | None, mask: NDArray[np.bool_] | None) -> None:
        """Begins episodes in all slots, or in those of the mask."""
        self.core.reset(seed, [] if mask is None else mask.astype(int).tolist())
        self._own_sums[slice(None) if mask is None else mask] = 0.0

    def ended(self) -> list[dict[str, Any]]:
        """What is known of each episode that the last step ended, by slot."""
        ends: list[dict[str, Any]] = self.core.ended()
        for end in ends:
            end["map_seed"] = np.uint64(end["map_seed"])  # Gymnasium makes an array of int64 of Python's numbers
            if self.reward_function is not None:
                end["reward_sum"] = float(self._own_sums[end["slot"]])
        return ends


def _default_threads() -> int:
    return len(os.sched_getaffinity(0))


def _sweep_text(sweep: Sweep) -> tuple[str, str | None]:
    if isinstance(sweep, Mapping):
        # Who flies is whoever steps; but a sweep names somebody.
        return "the sweep", yaml_text({"planners": ["straight_line"], **sweep}, "sweep")
    if not isinstance(sweep, (str, os.PathLike)):
        raise TypeError(f"sweep: expected a file, a name or a dict, got {type(sweep).__name__}")
    return plain_text(os.fspath(sweep), "sweep"), None


def _seed_of(seed: int | None) -> int | None:
    return None if seed is None else _whole(seed, "seed", 0, _MOST_SEED)


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
        action: "velocity" (vx, vy, vz, yaw rate), "acceleration" (ax, ay, az, yaw rate), "rates_thrust" (body rates,
            thrust over mass: 9.81 hovers), or "trajectory" (for each of `trajectory_points` x, y, z and yaw, from the
            vehicle's present place and heading, evenly spaced over `trajectory_horizon_s`). They take effect after the
            sweep's latency.
        frame: of velocities, accelerations and trajectories: "heading" or "world".
        reward: a Reward; a function of (observation, actions, default reward, terminated, truncated), arrays over N,
            that returns (N,); or None for zeros. It must return finite values; if it raises, the step has been flown
            nevertheless.
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
        action: str = "velocity",
        frame: str = "heading",
        trajectory_points: int = 10,
        trajectory_horizon_s: float = 1.0,
        reward: Reward | RewardFunction | None = Reward(),
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
        self.num_envs = _whole(num_envs, "num_envs", 1, 65536)
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.copy = copy
        self._flights: _Flights | None = _Flights(
            sweep,
            self.num_envs,
            threads,
            set,
            observe,
            depth,
            action,
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

    def _open(self) -> _Flights:
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
        flights.reset(_seed_of(seed), mask)
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
        action: str = "velocity",
        frame: str = "heading",
        trajectory_points: int = 10,
        trajectory_horizon_s: float = 1.0,
        reward: Reward | RewardFunction | None = Reward(),
        order: str = "random",
        seed: int = 1,
        kept_maps: int = 16,
        policy: str = "policy",
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode: expected 'rgb_array' or None, got {render_mode!r}")
        if render_mode is not None and not {"depth", "points", "ranges"} & {*_observed(observe)}:
            raise ValueError("render_mode: pictures show depth, points or ranges, and none of these is observed")
        self.render_mode = render_mode
        self._depth = depth
        self._flights: _Flights | None = _Flights(
            sweep,
            1,
            1,
            set,
            observe,
            depth,
            action,
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
        self.metadata = {**self.metadata, "render_fps": round(1.0 / self.step_s)}

    def _open(self) -> _Flights:
        if self._flights is None:
            raise gymnasium.error.ClosedEnvironmentError("the environment is closed: make another one")
        return self._flights

    def _seen(self) -> Observation:
        return {name: array[0].copy() for name, array in self._open().views.items()}

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begins the next episode, or with a seed the first one that this seed chooses. There are no options."""
        seed = _seed_of(seed)
        super().reset(seed=seed)
        if options:
            raise ValueError(f"options: {next(iter(options))!r} is not an option; there are none")
        self._open().reset(seed, None)
        return self._seen(), {}

    def step(self, action: NDArray[Any]) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Flies to the next observation, 1 / rates.plan_hz later. `action`: (width,).

        Gives the observation, the reward, terminated (goal, crash), truncated (time limit) and infos."""
        flights = self._open()
        array = _array(action, self.action_space.shape or (), "action")
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
            return _seen_from_above(flights.drawn[0, 0])
        depth = np.concatenate(list(flights.views["depth"][0]), axis=1)
        space = flights.observation_space["depth"]
        near = depth / float(space.high.max())  # type: ignore[attr-defined]
        bright = np.sqrt(near) if self._depth == "inverse" else np.where(depth > 0.0, 1.0 - near, 0.0)
        return np.repeat(np.round(255.0 * bright).astype(np.uint8)[..., np.newaxis], 3, axis=2)

    def close(self) -> None:
        """Ends threads and frees maps."""
        self._flights = None


__all__ = ["OBSERVATIONS", "AvoidbenchEnv", "AvoidbenchVectorEnv", "InputError", "Reward"]
