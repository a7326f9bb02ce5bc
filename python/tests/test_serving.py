"""Planners in Python that the program starts: what they see, and that they fly what avoidbench.fly flies."""

import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Any

import avoidbench
import pytest
from avoidbench import _core, serving
from avoidbench import planner_abi as abi
from avoidbench._location import program_file
from avoidbench.planner_files import local_modules, planner_files

EXAMPLES = Path(__file__).parent.parent / "examples"
HALL: dict[str, Any] = {
    "sweep": "serving",
    "maps": {"generator": "hall", "area_m": [14, 16], "poisson_radius_m": 4.0, "seeds": [1]},
    "trials": 2,
    "mission": {"time_limit_s": 3},
    "sensor": {"preset": "stereo_sgm", "width_px": 96, "height_px": 72},
}
# Gives up, or fails, with a digest of all that it was told.
TELLING = """
import hashlib

from avoidbench.planner import GiveUp, Parameter, Planner, Trajectory, Velocity

import told


class Telling(Planner):
    name = "telling"
    summary = "Says what it was told."
    sees = ("state", "depth", "stereo", "color", "imu", "states")
    commands = ("velocity", "trajectory")
    parameters = (Parameter("count", 3, "Whole.", lowest=1, highest=9), Parameter("word", "safe", "One of.", choices=("safe", "fast")),
                  Parameter("text", "Grüße", "Any."), Parameter("gain", 0.5, "Real."), Parameter("fails", 0, "Ends by an error.", lowest=0, highest=1))
    files = ("weights.txt",)

    def reset(self, mission):
        self.digest = hashlib.sha256(repr(told.plain(self.setup)).encode())
        self.add(mission)
        self.calls = 0

    def add(self, value):
        self.digest.update(repr(told.plain(value)).encode())

    def plan(self, observation):
        self.add(observation)
        self.calls += 1
        if self.calls == 20 and self.setup.parameters["fails"]:
            raise ValueError(self.digest.hexdigest())
        if self.calls == 20:
            raise GiveUp(self.digest.hexdigest())
        if self.calls % 3 == 0:
            return None
        if self.calls % 3 == 1:
            return Velocity([0.1, 0.2, 0.0], yaw_rate_radps=0.1, horizon_s=0.5)
        start = observation.position_world_m
        return Trajectory([0.0, 1.0], [start, start + [0.1, 0.0, 0.0]], [[0, 0, 0]] * 2, [[0, 0, 0]] * 2)
"""
TOLD = """
import dataclasses

import numpy as np


def plain(value):
    if dataclasses.is_dataclass(value):
        return [(field.name, plain(getattr(value, field.name))) for field in dataclasses.fields(value)]
    if isinstance(value, np.ndarray):
        return (value.dtype.str, value.shape, value.tobytes())
    if isinstance(value, dict):
        return sorted(value.items())
    return [plain(item) for item in value] if isinstance(value, tuple) else value
"""


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


@pytest.fixture(autouse=True)
def this_python(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AVOIDBENCH_PYTHON", sys.executable)


def call(*words: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(program_file()), *map(str, words)], capture_output=True, text=True)


def run(sweep: Any, database: Path, planner: Any) -> avoidbench.Results:
    with pytest.warns(UserWarning):
        return avoidbench.run({**sweep, "planners": [planner]}, database=database)


def test_structs_are_those_of_the_header() -> None:
    sizes = _core.struct_sizes()
    for form, name in (
        (serving.PLANNER, "ab_planner"),
        (serving.PARAMETER, "ab_parameter"),
        (serving.FILES, "ab_files"),
        (serving.SETUP, "ab_setup"),
        (serving.VALUE, "ab_value"),
        (serving.CAMERA, "ab_camera"),
        (serving.MISSION, "ab_mission"),
        (serving.OBSERVATION, "ab_observation"),
        (serving.DEPTH, "ab_depth_image"),
        (serving.PICTURE, "ab_picture"),
        (serving.STEREO, "ab_stereo_pair"),
    ):
        assert form.size == sizes[name], name
    assert serving.COMMAND_BYTES == sizes["ab_command"]
    assert serving.COMMAND_POINTS == abi.CommandStruct.points.offset
    assert 8 * serving.IMU_NUMBERS == sizes["ab_imu_sample"]
    assert 8 * (serving.STATE_NUMBERS + 1) == sizes["ab_state"]


def test_what_fly_flew_the_program_replays_and_does_not_fly_again(tmp_path: Path) -> None:
    planner = class_in(EXAMPLES / "straight_line.py", "StraightLine")
    sweep = {**HALL, "sensor": {"preset": "depth_ideal", "width_px": 24, "height_px": 16}}
    flown = avoidbench.fly(sweep, planner, database=tmp_path / "flown.db", progress=False)
    assert len(flown.trials) == 2
    replayed = call("replay", tmp_path / "flown.db", "--verify")
    assert (replayed.returncode, replayed.stdout) == (0, "2 trials flown again, 0 different\n"), replayed.stderr
    again = run(sweep, tmp_path / "flown.db", str(EXAMPLES / "straight_line.py"))
    assert list(again.trials["trial_key"]) == list(flown.trials["trial_key"])
    own = run(sweep, tmp_path / "own.db", str(EXAMPLES / "straight_line.py"))
    assert flown.compare(own, exact=True).passed


@pytest.mark.parametrize("fails", [0, 1])
def test_a_started_planner_is_told_the_same(tmp_path: Path, fails: int) -> None:
    file = tmp_path / "telling.py"
    file.write_text(TELLING, encoding="utf-8")
    (tmp_path / "told.py").write_text(TOLD)
    (tmp_path / "weights.txt").write_text("1")
    parameters = {"count": 5, "word": "fast", "text": "a\nb", "gain": 0.1, "fails": fails}
    flown = avoidbench.fly(
        HALL, class_in(file, "Telling"), parameters=parameters, database=tmp_path / "flown.db", progress=False
    )
    started = run(HALL, tmp_path / "started.db", {"plugin": str(file), "parameters": parameters})
    assert set(started.trials["outcome"]) == {"planner_error" if fails else "planner_gave_up"}
    assert list(started.trials["trial_key"]) == list(flown.trials["trial_key"])
    assert list(started.trials["reason"]) == list(flown.trials["reason"])
    assert flown.compare(started, exact=True).passed


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
