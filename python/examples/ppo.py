"""Learns to fly through an easy forest by depth, with PPO in plain NumPy, and compares with the planner straight_line.

    python ppo.py --out build/ppo                              # trains, evaluates, writes weights.npz, curve.csv,
    evaluation.json python ppo.py --out build/ppo --evaluate build/ppo/weights.npz

The policy sees the nearest depth in each cell of a 6 × 16 grid over the image, the vehicle's motion and the way to the
goal, ten times a second. Its action is a velocity in the heading frame and a yaw rate: what it adds to flying straight
to the goal. It trains on the maps 1 … 8 and is judged on others, once on each mission, beside straight_line on the same
missions with the same greatest speed.

PPO: Schulman et al., https://arxiv.org/abs/1707.06347; advantages: https://arxiv.org/abs/1506.02438. The same options
give the same weights on the same machine, for any number of threads of the flights."""

from __future__ import annotations

import argparse
import csv
import json
import os
import time
import warnings
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # of several threads, sums may differ in their last bits

import avoidbench
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flights = dict[tuple[int, int], tuple[str, float]]  # outcome and end_time_s of missions: map seed, index

MAX_SPEED_MPS, MAX_YAW_RATE_RADPS = 3.0, 1.5
GRID_ROWS, GRID_COLUMNS = 6, 16  # of the 48 × 64 image
STEPS_PER_UPDATE = 64  # of each slot
GAMMA, LAMBDA, CLIP, EPOCHS, MINIBATCHES, LEARNING_RATE = 0.99, 0.95, 0.2, 6, 8, 6e-4
REWARD_SCALE = 0.1  # so that returns are near 1
TRAINING_SEEDS, HELD_OUT_SEEDS = range(1, 9), range(101, 109)


def forest(name: str, seeds: Iterable[int], missions: int, **changes: Any) -> dict[str, Any]:
    """An easy forest: trees 5.5 m apart or more."""
    return {
        "sweep": name,
        "maps": {"generator": "forest", "area_m": [40, 40], "poisson_radius_m": 5.5, "seeds": list(seeds)},
        "trials": missions,
        "mission": {"time_limit_s": 30},
        "rates": {"plan_hz": 10},
        "sensor": {"preset": "depth_ideal", "width_px": 64, "height_px": 48, "rate_hz": 10},
        **changes,
    }


def features(seen: dict[str, NDArray[Any]]) -> Array:
    """(N, 106) of N observations with metric depth: nearness of what is nearest in each cell, motion, direction and
    distance of the goal."""
    depth_m = seen["depth"][:, 0].astype(np.float64)
    height, width = depth_m.shape[1:]
    cells = depth_m.reshape(-1, GRID_ROWS, height // GRID_ROWS, GRID_COLUMNS, width // GRID_COLUMNS).min(axis=(2, 4))
    goal_m = seen["goal"].astype(np.float64)
    distance_m = np.linalg.norm(goal_m, axis=1, keepdims=True)
    motion = seen["state"] / np.array([MAX_SPEED_MPS] * 3 + [1.0] * 3 + [3.0] * 3)
    return np.concatenate(
        [
            2.0 / (1.0 + cells.reshape(len(cells), -1)),
            motion,
            goal_m / np.maximum(distance_m, 0.1),
            np.log1p(distance_m) / 3.0,
        ],
        axis=1,
    )


def command(seen: dict[str, NDArray[Any]], added: Array) -> Array:
    """The environment's actions (N, 4): straight to the goal, plus what the policy adds, never faster than
    MAX_SPEED_MPS."""
    goal_m = seen["goal"].astype(np.float64)
    toward = goal_m / np.maximum(np.linalg.norm(goal_m, axis=1, keepdims=True), 0.1)
    velocity = toward + added[:, :3]
    velocity *= MAX_SPEED_MPS / np.maximum(1.0, np.linalg.norm(velocity, axis=1, keepdims=True))
    yaw_rate = np.arctan2(goal_m[:, 1], goal_m[:, 0]) + added[:, 3]
    return np.concatenate([velocity, np.clip(yaw_rate, -1.0, 1.0)[:, np.newaxis] * MAX_YAW_RATE_RADPS], axis=1)


class Network:
    """Two layers of tanh and a linear one. Learns by Adam."""

    def __init__(self, sizes: list[int], random: np.random.Generator, last_scale: float) -> None:
        self.parameters: list[Array] = []  # weights and biases in turn
        for layer, (rows, columns) in enumerate(zip(sizes, sizes[1:])):
            scale = last_scale if layer == len(sizes) - 2 else 1.0
            self.parameters += [scale * random.standard_normal((rows, columns)) / np.sqrt(rows), np.zeros(columns)]

    def forward(self, inputs: Array) -> list[Array]:
        """What each layer gives, the inputs first."""
        values = [inputs]
        for layer in range(0, len(self.parameters), 2):
            sums = values[-1] @ self.parameters[layer] + self.parameters[layer + 1]
            values.append(sums if layer == len(self.parameters) - 2 else np.tanh(sums))
        return values

    def __call__(self, inputs: Array) -> Array:
        return self.forward(inputs)[-1]

    def gradients(self, values: list[Array], of_outputs: Array) -> list[Array]:
        """Of a loss by each parameter, given those by the outputs of forward()."""
        found: list[Array] = []
        for layer in range(len(self.parameters) - 2, -1, -2):
            below = values[layer // 2]
            found = [below.T @ of_outputs, of_outputs.sum(axis=0), *found]
            of_outputs = (of_outputs @ self.parameters[layer].T) * (1.0 - below * below)
        return found


class Adam:
    """Changes parameters in place, against gradients whose norm is held to 0.5."""

    def __init__(self, parameters: list[Array]) -> None:
        self.parameters, self.steps = parameters, 0
        self.means = [np.zeros_like(p) for p in parameters]
        self.squares = [np.zeros_like(p) for p in parameters]

    def step(self, gradients: list[Array], rate: float) -> None:
        self.steps += 1
        scale = min(1.0, 0.5 / (1e-8 + np.sqrt(sum(float((g * g).sum()) for g in gradients))))
        for parameter, gradient, mean, square in zip(self.parameters, gradients, self.means, self.squares):
            mean += 0.1 * (scale * gradient - mean)
            square += 0.001 * ((scale * gradient) ** 2 - square)
            parameter -= rate * (mean / (1 - 0.9**self.steps)) / (np.sqrt(square / (1 - 0.999**self.steps)) + 1e-8)


class Learner:
    """A Gaussian policy, a value, and PPO's updates of both."""

    def __init__(self, seed: int) -> None:
        self.random = np.random.default_rng(seed)
        width = GRID_ROWS * GRID_COLUMNS + 13
        self.policy = Network([width, 128, 64, 4], self.random, 0.01)
        self.value = Network([width, 128, 64, 1], self.random, 0.1)
        self.log_std = np.full(4, np.log(0.4))
        self.policy_adam, self.value_adam = Adam([*self.policy.parameters, self.log_std]), Adam(self.value.parameters)

    def log_probability(self, actions: Array, means: Array) -> Array:
        """(N,), but for a constant."""
        return np.asarray((-0.5 * ((actions - means) / np.exp(self.log_std)) ** 2 - self.log_std).sum(axis=1))

    def update(
        self, inputs: Array, actions: Array, before: Array, advantages: Array, returns: Array, rate: float
    ) -> None:
        """All of one rollout, flat; `before`: log probabilities when the actions were drawn."""
        for _ in range(EPOCHS):
            for chosen in np.array_split(self.random.permutation(len(inputs)), MINIBATCHES):
                x, u, count = inputs[chosen], actions[chosen], len(chosen)
                gain = advantages[chosen]
                gain = (gain - gain.mean()) / (gain.std() + 1e-8)
                layers = self.policy.forward(x)
                ratio = np.exp(self.log_probability(u, layers[-1]) - before[chosen])
                is_held = np.where(gain > 0.0, ratio > 1.0 + CLIP, ratio < 1.0 - CLIP)
                weight = np.where(is_held, 0.0, -gain * ratio)[:, np.newaxis] / count  # of the log probabilities
                off = (u - layers[-1]) / np.exp(self.log_std)
                of_std = (weight * (off * off - 1.0)).sum(axis=0)
                self.policy_adam.step(
                    [*self.policy.gradients(layers, weight * off / np.exp(self.log_std)), of_std], rate
                )
                layers = self.value.forward(x)
                self.value_adam.step(
                    self.value.gradients(layers, (layers[-1] - returns[chosen, np.newaxis]) / count), rate
                )

    def save(self, file: Path) -> None:
        names = [f"policy_{i}" for i in range(len(self.policy.parameters))]
        np.savez(file, log_std=self.log_std, **dict(zip(names, self.policy.parameters)))  # type: ignore[arg-type]


def advantages_of(rewards: Array, ends: Array, values: Array, last_value: Array) -> Array:
    """(T, N), by generalized advantage estimation; after a step with an end nothing follows."""
    found, ahead, next_value = np.zeros_like(rewards), np.zeros(rewards.shape[1]), last_value
    for t in range(len(rewards) - 1, -1, -1):
        goes_on = 1.0 - ends[t]
        ahead = rewards[t] + GAMMA * next_value * goes_on - values[t] + GAMMA * LAMBDA * goes_on * ahead
        found[t], next_value = ahead, values[t]
    return found


def train(steps: int, seed: int, out: Path, slots: int = 64, threads: int | None = None) -> Network:
    """Flies `steps` steps, of all slots together, and learns; writes weights and curve into `out`."""
    learner, began_s = Learner(seed), time.monotonic()
    sweep = forest("ppo_training", TRAINING_SEEDS, 40, rates={"plan_hz": 10, "physics_hz": 250, "sample_hz": 50})
    flights = avoidbench.AvoidbenchVectorEnv(
        sweep, slots, threads=threads, depth="metric", seed=seed, autoreset_mode="SameStep"
    )
    seen, _ = flights.reset()
    updates = max(1, steps // (slots * STEPS_PER_UPDATE))
    rows: list[dict[str, float]] = []
    for update in range(updates):
        inputs: list[Array] = []
        actions: list[Array] = []
        before: list[Array] = []
        rewards: list[Array] = []
        ends: list[Array] = []
        outcomes: list[str] = []
        flown_rewards: list[float] = []
        for _ in range(STEPS_PER_UPDATE):
            x = features(seen)
            means = learner.policy(x)
            u = means + np.exp(learner.log_std) * learner.random.standard_normal(means.shape)
            seen, reward, terminated, truncated, infos = flights.step(command(seen, u))
            reward = REWARD_SCALE * reward
            if truncated.any():  # the flight could have gone on: what it would have been worth
                lasts = infos["final_obs"][truncated]
                stacked = {name: np.stack([last[name] for last in lasts]) for name in lasts[0]}
                reward[truncated] += GAMMA * learner.value(features(stacked))[:, 0]
            if "final_info" in infos:
                ended = infos["final_info"]
                outcomes += list(ended["outcome"][ended["_outcome"]])
                flown_rewards += list(ended["reward_sum"][ended["_outcome"]])
            for kept, array in (
                (inputs, x),
                (actions, u),
                (before, learner.log_probability(u, means)),
                (rewards, reward),
                (ends, (terminated | truncated).astype(np.float64)),
            ):
                kept.append(array)
        flat = np.concatenate(inputs)
        values = learner.value(flat)[:, 0].reshape(STEPS_PER_UPDATE, slots)
        gains = advantages_of(np.array(rewards), np.array(ends), values, learner.value(features(seen))[:, 0])
        learner.update(
            flat,
            np.concatenate(actions),
            np.concatenate(before),
            gains.ravel(),
            (gains + values).ravel(),
            LEARNING_RATE * (1.0 - update / updates),
        )
        count = max(1, len(outcomes))
        rows.append(
            {
                "steps": (update + 1) * slots * STEPS_PER_UPDATE,
                "wall_s": round(time.monotonic() - began_s, 1),
                "episodes": len(outcomes),
                "success_rate": outcomes.count("reached_goal") / count,
                "reward_mean": float(np.mean(flown_rewards)) if flown_rewards else float("nan"),
                "std_mean": float(np.exp(learner.log_std).mean()),
            }
        )
        print(" ".join(f"{name} {value:.6g}" for name, value in rows[-1].items()), flush=True)
    flights.close()
    learner.save(out / "weights.npz")
    with open(out / "curve.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    return learner.policy


def fly_held_out(policy: Network, missions: int, threads: int | None = None) -> Flights:
    """The missions of the held-out maps, each flown once, without the training's noise."""
    sweep = forest("ppo_held_out", HELD_OUT_SEEDS, missions)
    flights = avoidbench.AvoidbenchVectorEnv(
        sweep, len(HELD_OUT_SEEDS), threads=threads, depth="metric", order="in_turn", autoreset_mode="SameStep"
    )
    found: Flights = {}
    seen, _ = flights.reset()
    while (flights.rounds == 0).any():
        seen, _, terminated, truncated, infos = flights.step(command(seen, policy(features(seen))))
        for slot in np.flatnonzero(terminated | truncated):
            end = infos["final_info"]
            if end["round"][slot] == 0:  # a slot that is done begins again
                mission = int(end["map_seed"][slot]), int(end["mission_index"][slot])
                found[mission] = str(end["outcome"][slot]), float(end["end_time_s"][slot])
    flights.close()
    return found


def fly_straight(missions: int, out: Path) -> Flights:
    """The same for straight_line, flown by the program."""
    sweep = forest(
        "ppo_held_out",
        HELD_OUT_SEEDS,
        missions,
        planners=[{"plugin": "straight_line", "parameters": {"max_speed_mps": MAX_SPEED_MPS}}],
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that one planner is compared with none
        trials = avoidbench.run(sweep, database=out / "straight_line.db", progress=False).trials
    columns = (trials[name] for name in ("map_seed", "mission_index", "outcome", "end_time_s"))
    return {(int(seed), int(index)): (str(outcome), float(time_s)) for seed, index, outcome, time_s in zip(*columns)}


def wilson(count: int, of: int) -> tuple[float, float]:
    """The 95 % interval of a rate (Wilson 1927), of missions that are independent. The report's is wider where those of
    one map are alike."""
    z, rate = 1.959963984540054, count / of
    middle, half = rate + z * z / (2 * of), z * np.sqrt(rate * (1 - rate) / of + z * z / (4 * of * of))
    return float((middle - half) / (1 + z * z / of)), float((middle + half) / (1 + z * z / of))


def evaluate(policy: Network, out: Path, missions: int = 20, threads: int | None = None) -> dict[str, Any]:
    """Success rates on the held-out missions; writes them into `out`."""
    flown = {"ppo": fly_held_out(policy, missions, threads), "straight_line": fly_straight(missions, out)}
    shared = sorted(flown["ppo"].keys() & flown["straight_line"].keys())
    goals = {name: [flights[mission][0] == "reached_goal" for mission in shared] for name, flights in flown.items()}
    pairs = list(zip(goals["ppo"], goals["straight_line"]))
    found: dict[str, Any] = {
        "missions": len(shared),
        "only_ppo": pairs.count((True, False)),
        "only_straight_line": pairs.count((False, True)),
    }
    for name, flights in flown.items():
        count = sum(goals[name])
        lower, upper = wilson(count, len(shared))
        outcomes = dict(Counter(flights[mission][0] for mission in shared))
        times_s = [flights[mission][1] for mission, pair in zip(shared, pairs) if all(pair)]
        found[name] = {
            "reached": count,
            "success_rate": count / len(shared),
            "lower": lower,
            "upper": upper,
            "outcomes": outcomes,
            "mean_time_where_both_reached_s": float(np.mean(times_s)) if times_s else None,
        }
        print(f"{name:14} {count}/{len(shared)} = {count / len(shared):.2f} [{lower:.2f}, {upper:.2f}]  {outcomes}")
    print(f"reached by ppo alone: {found['only_ppo']}, by straight_line alone: {found['only_straight_line']}")
    (out / "evaluation.json").write_text(json.dumps(found, indent=1) + "\n")
    return found


def load(file: Path) -> Network:
    """The policy that save() wrote."""
    with np.load(file) as stored:
        parameters = [stored[f"policy_{i}"] for i in range(len(stored.files) - 1)]
    policy = Network([GRID_ROWS * GRID_COLUMNS + 13, 4], np.random.default_rng(0), 1.0)
    policy.parameters = parameters
    return policy


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=400_000, help="of all flights together, ten a simulated second")
    parser.add_argument("--seed", type=int, default=1, help="of weights, noise and the order of the missions")
    parser.add_argument("--out", type=Path, default=Path("ppo"), help="folder for what is written")
    parser.add_argument("--evaluate", type=Path, metavar="WEIGHTS", help="do not train: judge these weights")
    parser.add_argument(
        "--missions", type=int, default=20, help="held-out ones of each of the eight maps; 0: train only"
    )
    parser.add_argument("--slots", type=int, default=64, help="flights at once while it trains")
    parser.add_argument("--threads", type=int, help="of the flights; default: all processors")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    policy = (
        load(arguments.evaluate)
        if arguments.evaluate
        else train(arguments.steps, arguments.seed, arguments.out, arguments.slots, arguments.threads)
    )
    if arguments.missions > 0:
        evaluate(policy, arguments.out, arguments.missions, arguments.threads)


if __name__ == "__main__":
    main()
