"""Planners in Python that the program starts: from which files, and that fly() flies what a sweep does."""

import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Any

import avoidbench
import pytest
from avoidbench.planner_files import local_modules, planner_files
from avoidbench.program import ProgramError, environment, find_program

EXAMPLES = Path(__file__).parent.parent / "examples"
HALL: dict[str, Any] = {
    "sweep": "serving",
    "maps": {"generator": "hall", "area_m": [14, 16], "poisson_radius_m": 4.0, "seeds": [1]},
    "trials": 2,
    "mission": {"time_limit_s": 3},
    "sensor": {"preset": "stereo_sgm", "width_px": 96, "height_px": 72},
}


def class_in(file: Path, name: str) -> Any:
    spec = importlib.util.spec_from_file_location(file.stem, file)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[file.stem] = module
    sys.path.insert(0, str(file.parent))
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(file.parent))
    return getattr(module, name)


def call(*words: Any) -> subprocess.CompletedProcess[str]:
    command = [str(find_program()), *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, env=environment())


def run(sweep: Any, database: Path, planner: Any) -> avoidbench.Results:
    with pytest.warns(UserWarning):
        return avoidbench.run({**sweep, "planners": [planner]}, database=database)


FILTER = """
from avoidbench.planner import Planner, Velocity

class Mine(Planner):
    name = "mine"
    inputs = ("state", "command")
    commands = ("velocity", "trajectory")

    def plan(self, observation):
        wanted = observation.wanted
        return {answer}
"""


def test_a_filter_in_python_passes_commands_on_or_changes_them(tmp_path: Path) -> None:
    halved = "Velocity(0.5 * wanted.velocity_world_mps, yaw_rad=wanted.yaw_rad)"
    for name, answer in (("passes", "wanted"), ("halves", halved)):
        (tmp_path / f"{name}.py").write_text(FILTER.format(answer=answer))
    flights = {}
    for plugin in ("straight_line", "ego"):
        for name in ("alone", "passes", "halves"):
            if (plugin, name) == ("ego", "halves"):
                continue
            planner = {"plugin": plugin, "label": "it"}
            if name != "alone":
                planner["filter"] = str(tmp_path / f"{name}.py")
            trial = run(HALL, tmp_path / f"{plugin}_{name}.db", planner).trials.iloc[1]  # that no obstacle ends
            flights[plugin, name] = (trial["outcome"], trial["path_length_m"])
    assert flights["straight_line", "passes"] == flights["straight_line", "alone"]
    assert flights["ego", "passes"] == flights["ego", "alone"]
    assert flights["straight_line", "halves"][1] < 0.7 * flights["straight_line", "alone"][1]
    with pytest.raises(ProgramError, match="mine is a filter and flies only on top of a planner"):
        avoidbench.run({**HALL, "planners": [str(tmp_path / "passes.py")]}, database=tmp_path / "none.db")


def test_what_fly_flew_the_program_replays_and_does_not_fly_again(tmp_path: Path) -> None:
    planner = class_in(EXAMPLES / "straight_line.py", "StraightLine")
    sweep = {**HALL, "sensor": {"preset": "depth_ideal", "width_px": 24, "height_px": 16}}
    with pytest.warns(UserWarning):
        flown = avoidbench.fly(sweep, planner, database=tmp_path / "flown.db", progress=False)
    assert len(flown.trials) == 2
    replayed = call("replay", tmp_path / "flown.db", "--verify")
    assert (replayed.returncode, replayed.stdout) == (0, "2 trials flown again, 0 different\n"), replayed.stderr
    again = run(sweep, tmp_path / "flown.db", str(EXAMPLES / "straight_line.py"))
    assert list(again.trials["trial_key"]) == list(flown.trials["trial_key"])
    own = run(sweep, tmp_path / "own.db", str(EXAMPLES / "straight_line.py"))
    assert flown.compare(own, exact=True).passed


def test_files_are_found_in_the_sources(tmp_path: Path) -> None:
    (tmp_path / "package" / "inner").mkdir(parents=True)
    for name, text in {
        "mine.py": "import numpy, helper\nfrom package import part\n",
        "helper.py": "import other_helper\n",
        "other_helper.py": "",
        "unused.py": "",
        "package/__init__.py": "from . import own\n",
        "package/own.py": "",
        "package/part.py": "from .inner.deep import x\n",
        "package/inner/__init__.py": "",
        "package/inner/deep.py": "import helper\nx = 1\n",
    }.items():
        (tmp_path / name).write_text(text)
    modules = [module.as_posix() for module in local_modules(tmp_path / "mine.py")]
    assert modules == [
        "helper.py",
        "other_helper.py",
        "package/__init__.py",
        "package/inner/__init__.py",
        "package/inner/deep.py",
        "package/own.py",
        "package/part.py",
    ]
    assert planner_files(tmp_path / "mine.py", ("w.npz", "helper.py"))[:2] == ["w.npz", "helper.py"]


def test_by_hand_it_says_what_it_is() -> None:
    planner = class_in(EXAMPLES / "straight_line.py", "StraightLine")
    with pytest.raises(SystemExit, match="straight_line is a planner: name this file in a sweep"):
        avoidbench.serve(planner)
