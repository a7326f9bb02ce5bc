"""The examples, run with small sizes as a user runs them."""

from __future__ import annotations

import csv
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).parent.parent / "examples"


def run_example(name: str, *arguments: object, limit_s: float = 240) -> str:
    """What it prints."""
    command = [sys.executable, str(EXAMPLES / name), *map(str, arguments)]
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=limit_s)
    assert done.returncode == 0, done.stderr
    return done.stdout


def digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


def test_depth_dataset_is_true_and_the_same_again(tmp_path: Path) -> None:
    for name in ("a.npz", "b.npz"):
        run_example("depth_dataset.py", tmp_path / name, "--generator", "hall", "--maps", 2, "--images", 20)
    assert digest(tmp_path / "a.npz") == digest(tmp_path / "b.npz")
    with np.load(tmp_path / "a.npz") as data:
        assert data["depth_m"].shape == (40, 48, 64)
        assert data["depth_m"].dtype == np.float32
        assert data["free_m"].shape == (40, len(data["direction_rad"]))
        assert set(data["map_seed"]) == {1, 2}
        assert (data["nearest_m"] > 0.4).all()
        assert (data["free_m"] >= 0.0).all()
        assert len(np.unique(data["best"])) > 1
        # Straight on the ball can't fly farther than the picture's middle shows, which is on its way.
        ahead = int(np.argmin(np.abs(data["direction_rad"])))
        middle_m = np.nan_to_num(data["depth_m"][:, 23:25, 31:33].min(axis=(1, 2)), nan=0.1)
        assert (data["free_m"][:, ahead] <= middle_m + 0.05).all()


def test_scripted_policy_reaches_goals() -> None:
    lines = run_example("scripted_policy.py", "--hall", "--episodes", 8, "--slots", 8).splitlines()
    counts = {line.split()[0]: int(line.split()[1]) for line in lines}
    assert sum(counts.values()) == 8
    assert counts["reached_goal"] >= 6


def test_ppo_gives_the_same_weights_for_any_number_of_threads(tmp_path: Path) -> None:
    one, two, judged = (tmp_path / name for name in ("one", "two", "judged"))
    small = ("--steps", 512, "--slots", 4)
    run_example("ppo.py", *small, "--missions", 0, "--threads", 1, "--out", one)
    assert "straight_line" in run_example("ppo.py", *small, "--missions", 1, "--threads", 2, "--out", two)
    assert digest(one / "weights.npz") == digest(two / "weights.npz")
    with open(one / "curve.csv", newline="") as file:
        assert [row["steps"] for row in csv.DictReader(file)] == ["256", "512"]
    run_example("ppo.py", "--evaluate", one / "weights.npz", "--missions", 1, "--threads", 1, "--out", judged)
    found = json.loads((judged / "evaluation.json").read_text())
    assert found == json.loads((two / "evaluation.json").read_text())
    assert found["missions"] == 8


def test_results_are_printed_and_drawn(tiny_db: Path, tmp_path: Path) -> None:
    printed = run_example("results_to_pandas.py", tiny_db, "--picture", tmp_path / "paths.png")
    assert "straight_line" in printed
    assert (tmp_path / "paths.png").stat().st_size > 1000


@pytest.mark.parametrize("name", sorted(file.name for file in EXAMPLES.glob("*.py") if file.name != "straight_line.py"))
def test_help_says_what_it_is(name: str) -> None:
    assert "usage:" in run_example(name, "--help")
