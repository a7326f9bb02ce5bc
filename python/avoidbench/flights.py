"""The flights of environments (avoidbench.env): their options, spaces and arrays."""

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
from numpy.typing import ArrayLike, NDArray

from avoidbench._extension import core as _core
from avoidbench._input import plain_places
from avoidbench._text import overrides, plain_text, yaml_text

Observation = dict[str, NDArray[Any]]
Sweep = str | os.PathLike[str] | Mapping[str, Any]
RewardFunction = Callable[
    [Observation, NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_]], ArrayLike
]

DEPTH_TYPES = ("float32", "uint8")
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


DEFAULT_REWARD = Reward()


def whole(value: SupportsIndex, name: str, lowest: int, highest: int) -> int:
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


def observed(observe: Sequence[str]) -> tuple[str, ...]:
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
    """Of one flight, as the extension writes it."""
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


def depth_bytes(depth: NDArray[np.float32], greatest: float) -> NDArray[np.uint8]:
    """Depth 0 … `greatest` in 255 steps: 0 stays unknown, v becomes 1 + 254 v / `greatest`, rounded."""
    steps = np.rint(depth * np.float32(254.0 / greatest))
    steps += depth > 0.0
    return np.asarray(steps, np.uint8)


def seen_from_above(points: NDArray[np.float32]) -> NDArray[np.uint8]:
    """A grey picture (200, 200, 3) of a sweep (S, 3): its lidar in the middle, x up, y to the left, 10 pixels a metre;
    what is within 1 m above and below is white, else it is grey."""
    met = points[points.any(axis=1)]
    rows, columns = np.round(100.0 - 10.0 * met[:, :2].astype(np.float64)).astype(np.int64).T
    shown = (rows >= 0) & (rows < 200) & (columns >= 0) & (columns < 200)
    picture = np.zeros((200, 200), np.uint8)
    np.maximum.at(picture, (rows[shown], columns[shown]), np.where(np.abs(met[shown, 2]) < 1.0, 255, 90))
    return np.repeat(picture[..., np.newaxis], 3, axis=2)


def real_array(actions: ArrayLike, wanted: tuple[int, ...], name: str) -> NDArray[Any]:
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


class Flights:
    """The flights of an environment, their arrays and spaces."""

    def __init__(
        self,
        sweep: Sweep,
        slots: int,
        threads: int | None,
        set: Mapping[str, Any] | None,
        observe: Sequence[str],
        depth: str,
        depth_dtype: str,
        action: str,
        unit_actions: bool,
        frame: str,
        trajectory_points: SupportsIndex,
        trajectory_horizon_s: float,
        reward: Reward | RewardFunction | None,
        order: str,
        seed: SupportsIndex,
        kept_maps: SupportsIndex,
        policy: str,
    ) -> None:
        self.observe, self.slots = observed(observe), slots
        for name, word in (
            ("depth", depth),
            ("depth_dtype", depth_dtype),
            ("action", action),
            ("frame", frame),
            ("order", order),
            ("policy", policy),
        ):
            if not isinstance(word, str):
                raise TypeError(f"{name}: expected a word, got {type(word).__name__}")
        if depth_dtype not in DEPTH_TYPES:
            raise ValueError(f"depth_dtype: expected {' or '.join(DEPTH_TYPES)}, got {depth_dtype!r}")
        if not isinstance(unit_actions, (bool, np.bool_)):
            raise TypeError(f"unit_actions: expected True or False, got {type(unit_actions).__name__}")
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
            "threads": whole(_default_threads() if threads is None else threads, "threads", 1, 1024),
            "seed": whole(seed, "seed", 0, _MOST_SEED),
            "kept_maps": whole(kept_maps, "kept_maps", 1, 10**6),
            "trajectory_points": whole(trajectory_points, "trajectory_points", 1, 1000),
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
        lowest, highest = np.array(shape["action_lowest"]), np.array(shape["action_highest"])
        # What an action of 0 means, and how far ±1 is from it, in SI units.
        self._unit = ((highest + lowest) / 2.0, (highest - lowest) / 2.0) if unit_actions else None
        ones = np.ones(len(lowest), np.float32)
        self.action_space = (
            gymnasium.spaces.Box(-ones, ones)
            if unit_actions
            else gymnasium.spaces.Box(lowest.astype(np.float32), highest.astype(np.float32))
        )
        spaces: dict[str, gymnasium.Space[Any]] = {name: _view_space(name, shape, depth) for name in self.observe}
        self.views: Observation = {name: self._view(name, space) for name, space in spaces.items()}
        self.depth = self.views.get("depth")
        """(N, C, H, W) float32, whatever is given to the learner."""
        self.depth_greatest_m = float(shape["max_range_m"]) if self.depth is not None else math.nan
        self.depth_greatest = float(spaces["depth"].high.max()) if self.depth is not None else 0.0  # type: ignore[attr-defined]
        self._is_depth_bytes = self.depth is not None and depth_dtype == "uint8"
        if self.depth is not None and self._is_depth_bytes:
            spaces["depth"] = gymnasium.spaces.Box(0, 255, self.depth.shape[1:], np.uint8)
            self.views["depth"] = np.zeros(self.depth.shape, np.uint8)
        self.observation_space = gymnasium.spaces.Dict(spaces)
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

    def _code_depth(self) -> None:
        if self.depth is not None and self._is_depth_bytes:
            self.views["depth"][:] = depth_bytes(self.depth, self.depth_greatest)

    @property
    def terminated(self) -> NDArray[np.bool_]:
        return np.asarray(self._ends[0] != 0)

    @property
    def truncated(self) -> NDArray[np.bool_]:
        return np.asarray(self._ends[1] != 0)

    def step(self, actions: ArrayLike, begins_next: bool) -> None:
        """`actions`: (slots, width)."""
        array = real_array(actions, (self.slots, *(self.action_space.shape or ())), "actions")
        numbers = np.ascontiguousarray(array, np.float64)
        if self._unit is not None:
            numbers = self._unit[0] + self._unit[1] * numbers
        before = self.terminated | self.truncated
        self._own_sums[before] = 0.0
        self.core.step(numbers, begins_next)
        self._code_depth()
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
        self._code_depth()
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


def seed_of(seed: int | None) -> int | None:
    return None if seed is None else whole(seed, "seed", 0, _MOST_SEED)
