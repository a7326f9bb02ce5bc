"""Results that several tests read: flown once, by the program that AVOIDBENCH_PROGRAM names."""

from __future__ import annotations

import os
import subprocess
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import avoidbench
import pytest
from avoidbench.program import find_program

TINY: dict[str, Any] = {
    "sweep": "tiny",
    "seed": 3,
    "maps": {"generator": "hall", "seeds": [1]},
    "trials": 2,
    "planners": ["straight_line", "reactive"],
    "max_speed_mps": 3,
}


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--long", action="store_true", help="as many steps and resets as the slow tests do")


@pytest.fixture(scope="session")
def is_long(request: pytest.FixtureRequest) -> bool:
    return bool(request.config.getoption("--long"))


Program = Callable[..., bytes]


@pytest.fixture(scope="session")
def program() -> Program:
    """Runs the program itself, apart from the package, and gives its standard output."""
    # Without the sanitizers' runtime, which is loaded before Python: it does not live through forks beside threads, and
    # the program forks.
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}

    def run_it(*arguments: object) -> bytes:
        return subprocess.run(
            [find_program(), *map(str, arguments)], check=True, capture_output=True, env=environment
        ).stdout

    return run_it


def fly(sweep: dict[str, Any], database: Path, **options: Any) -> avoidbench.Results:
    """run() without a bar and its warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return avoidbench.run(sweep, database=database, progress=False, **options)


@pytest.fixture(scope="session")
def tiny_db(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A hall, two missions, two planners: two trials collide, two reach the goal."""
    path = tmp_path_factory.mktemp("tiny") / "tiny.db"
    fly(TINY, path)
    return path


@pytest.fixture(scope="session")
def odd_db(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Axes of numbers and of lists, the largest seed, a label that looks like a formula, measured latency; then
    a second revision with fewer trials, and another sweep."""
    path = tmp_path_factory.mktemp("odd") / "odd.db"
    sweep: dict[str, Any] = {
        "sweep": "odd",
        "maps": {"generator": "hall", "seeds": [2**64 - 1]},
        "trials": 1,
        "max_speed_mps": 3,
        "planners": [{"plugin": "straight_line", "label": "=a+b"}],
        "latency": {"mode": "measured", "scale": 3},
        "axes": {"wind.mean_world_mps": [[0, 0, 0], [4, 0, 0]], "vehicle.mass_kg": [0.7, 0.75]},
    }
    fly(sweep, path)
    sweep["axes"] = {"vehicle.mass_kg": [0.7]}
    fly(sweep, path)
    fly({**TINY, "sweep": "other", "trials": 1, "planners": ["straight_line"]}, path)
    return path
