"""AvoidbenchVectorEnv as a vector environment of Stable-Baselines3 (`pip install stable-baselines3`), which only this
module imports."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv  # type: ignore[import-not-found, unused-ignore]

from avoidbench.env import AvoidbenchVectorEnv


def _of_slot(infos: dict[str, Any], slot: int) -> dict[str, Any]:
    """What a vector's infos say of one slot."""
    return {
        name: _of_slot(values, slot) if isinstance(values, dict) else values[slot]
        for name, values in infos.items()
        if not name.startswith("_")
    }


class Sb3VecEnv(VecEnv):  # type: ignore[misc, unused-ignore]
    """Flights for the learners of Stable-Baselines3, stepped together in this process.

    The infos of an episode's end have what avoidbench gives (outcome, metrics, …) and what Stable-Baselines3 reads:
    terminal_observation, TimeLimit.truncated (the mission's time was up), is_success (the goal was reached) and
    episode: r, the sum of rewards; l, steps; t, simulated seconds.

    Args:
        envs: with autoreset_mode="SameStep". Its `unit_actions` suits learners that expect actions in [-1, 1], and
            its `depth_dtype="uint8"` those that give images to a convolutional network.

    Raises ValueError if it has another autoreset_mode."""

    def __init__(self, envs: AvoidbenchVectorEnv) -> None:
        if envs.autoreset_mode != AutoresetMode.SAME_STEP:
            raise ValueError(f"autoreset_mode: expected 'SameStep', got {envs.autoreset_mode.value!r}")
        self.envs = envs
        self._actions: NDArray[Any] | None = None
        super().__init__(envs.num_envs, envs.single_observation_space, envs.single_action_space)

    def reset(self) -> dict[str, NDArray[Any]]:
        """Begins an episode in each slot. The number given to seed() chooses them, of all slots."""
        seen, _ = self.envs.reset(seed=self._seeds[0])
        self.reset_infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        self._reset_seeds()
        self._reset_options()
        return seen

    def step_async(self, actions: NDArray[Any]) -> None:
        self._actions = actions

    def step_wait(self) -> tuple[dict[str, NDArray[Any]], NDArray[Any], NDArray[Any], list[dict[str, Any]]]:
        """Gives observations, rewards (N,) float32, whether episodes ended (N,) bool, and infos by slot. Where one
        ended, the observation is the first of the next episode."""
        assert self._actions is not None, "step_async() comes first"
        seen, rewards, terminated, truncated, all_infos = self.envs.step(self._actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        ended = terminated | truncated
        for slot in map(int, np.flatnonzero(ended)):
            end = _of_slot(all_infos["final_info"], slot)
            infos[slot] = {
                **end,
                "terminal_observation": all_infos["final_obs"][slot],
                "TimeLimit.truncated": bool(truncated[slot] and not terminated[slot]),
                "is_success": end["outcome"] == "reached_goal",
                "episode": {"r": float(end["reward_sum"]), "l": int(end["steps"]), "t": float(end["end_time_s"])},
            }
        return seen, rewards.astype(np.float32), ended, infos

    def close(self) -> None:
        self.envs.close()

    def _slots(self, indices: int | Sequence[int] | None) -> list[int]:
        return list(self._get_indices(indices))

    def get_attr(self, attr_name: str, indices: int | Sequence[int] | None = None) -> list[Any]:
        """The attribute of the vector, for each slot."""
        return [getattr(self.envs, attr_name) for _ in self._slots(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: int | Sequence[int] | None = None) -> None:
        raise NotImplementedError("slots have no attributes of their own: make another environment")

    def env_method(
        self, method_name: str, *method_args: Any, indices: int | Sequence[int] | None = None, **method_kwargs: Any
    ) -> list[Any]:
        raise NotImplementedError("slots have no methods of their own")

    def env_is_wrapped(self, wrapper_class: type[Any], indices: int | Sequence[int] | None = None) -> list[bool]:
        return [False for _ in self._slots(indices)]
