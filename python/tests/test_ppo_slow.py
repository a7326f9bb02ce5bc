"""The example ppo.py learns: with a quarter of its steps, in minutes."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
from test_examples import run_example


def test_reward_rises_and_more_goals_are_reached(tmp_path: Path) -> None:
    run_example("ppo.py", "--steps", 100_000, "--missions", 5, "--out", tmp_path, limit_s=1500)
    with open(tmp_path / "curve.csv", newline="") as file:
        # The first flights that end are those that crash soon: their mean says little.
        rewards = [float(row["reward_mean"]) for row in csv.DictReader(file)][2:]
    assert np.mean(rewards[-5:]) > np.mean(rewards[:5]) + 5.0
    found = json.loads((tmp_path / "evaluation.json").read_text())
    assert found["ppo"]["lower"] > found["straight_line"]["upper"]
