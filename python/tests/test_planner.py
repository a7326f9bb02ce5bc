"""Planners written in Python, flown by fly(): what they see and give, mistakes, and from where they are flown."""

import base64
import json
import linecache
import re
import subprocess
import sys
import types
import warnings
from pathlib import Path
from typing import Any

import avoidbench
import numpy as np
import pytest
from avoidbench import portable_math
from avoidbench.planner import Parameter, Planner

from planners import (
    ANSWERS,
    AllEyed,
    Commanding,
    Follower,
    OneEyed,
    Patrol,
    Pointed,
    Preset,
    Seeing,
    Undeclared,
    Watcher,
)

EXAMPLES = Path(__file__).parent.parent / "examples"
sys.path.insert(0, str(EXAMPLES))

from straight_line import StraightLine  # noqa: E402

HALL: dict[str, Any] = {
    "sweep": "tests",
    "maps": {"generator": "hall", "area_m": [14, 16], "poisson_radius_m": 4.0, "seeds": [1]},
    "trials": 1,
    "mission": {"time_limit_s": 2},
    "sensor": {"preset": "depth_ideal", "width_px": 24, "height_px": 16},
}


def fly(planner: Any, folder: Path, **changes: Any) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return avoidbench.fly(
            {**HALL, **changes.pop("sweep", {})}, planner, database=folder / "flown.db", progress=False, **changes
        )


def only_trial(planner: type[Planner], folder: Path, **changes: Any) -> Any:
    trials = fly(planner, folder, **changes).trials
    assert len(trials) == 1
    return trials.iloc[0]


def told(planner: type[Planner], folder: Path, **changes: Any) -> str:
    """What it says where it gives up."""
    trial = only_trial(planner, folder, **changes)
    assert trial["outcome"] == "planner_gave_up", trial["reason"]
    return str(trial["reason"])


def test_portable_math_is_close_to_pythons() -> None:
    import math

    for name in portable_math.__all__:
        arguments = (0.3, -0.7) if name == "atan2" else (0.3,)
        assert getattr(portable_math, name)(*arguments) == pytest.approx(getattr(math, name)(*arguments), rel=1e-15)


def test_straight_line_in_python_flies_the_librarys_rows(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        own = avoidbench.fly("quick", StraightLine, database=tmp_path / "own.db", progress=False, jobs=2)
        library = avoidbench.run(
            "quick", set={"planners": ["straight_line"]}, database=tmp_path / "library.db", progress=False
        )
    assert len(own.trials) == 8
    comparison = library.compare(own, exact=True)
    assert "bit for bit" in str(comparison)
    for key_own, key in zip(own.trials["trial_key"], library.trials["trial_key"], strict=True):
        assert key_own != key, "another file is another planner"
        np.testing.assert_array_equal(own.trajectory(key_own).to_numpy(), library.trajectory(key).to_numpy())


def test_what_is_seen(tmp_path: Path) -> None:
    told_text = told(Seeing, tmp_path, parameters={"count": 4, "word": "fast", "gain": 0.25})
    seen = json.loads(told_text)
    assert seen["parameters"] == {"count": 4, "word": "fast", "text": "Grüße", "gain": 0.25}
    assert (seen["size_px"], seen["left"], seen["color"]) == ([24, 16], [16, 24], [16, 24, 3])
    assert seen["plan_period_s"] == pytest.approx(1 / 30)
    assert seen["mission.time_limit_s"] == 2.0
    assert not seen["is_writable"]
    assert seen["place"] == seen["mission.start_world_m"]
    assert np.linalg.norm(seen["eyes_m"]) == pytest.approx(seen["baseline_m"])
    np.testing.assert_allclose(seen["imu"], [0.0, 0.0, 9.81], atol=0.5)
    np.testing.assert_allclose(seen["times_s"], 1.0, atol=1e-9)
    np.testing.assert_array_equal(seen["state_times_s"], seen["imu_times_s"])
    assert seen["state_times_s"][-1] == seen["times_s"][0] and len(seen["state_times_s"]) > 1
    world = avoidbench.make_world("hall", seed=1, area_m=[14, 16], poisson_radius_m=4.0)
    position, (w, x, y, z) = seen["camera"]
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, 3] = position
    expected = world.depth(pose, sensor={"preset": "depth_ideal", "width_px": 24, "height_px": 16})
    depth = np.frombuffer(base64.b64decode(seen["depth"]), np.float32).reshape(16, 24)
    np.testing.assert_allclose(depth, expected, rtol=1e-4)


RIG = {"preset": "depth_ideal", "width_px": 24, "height_px": 16, "more_mountings": [{"yaw_deg": 90}]}


def test_a_planner_of_one_camera_is_given_one(tmp_path: Path) -> None:
    with pytest.raises(
        avoidbench.InputError, match=r"one_eyed can't fly with sensor 'depth_ideal': it handles one camera and gets 2"
    ):
        only_trial(OneEyed, tmp_path, sweep={"sensor": RIG})
    with pytest.raises(avoidbench.InputError, match=r"needs a view of 57.3° × 28.6° or more"):
        only_trial(OneEyed, tmp_path, sweep={"sensor": {**RIG, "more_mountings": [], "fov_x_deg": 50}})
    turns = [
        float(told(OneEyed, tmp_path, sweep={"sensor": RIG}, camera=camera, label=f"eye{camera}")) for camera in (0, 1)
    ]
    assert abs((turns[1] - turns[0]) % 360.0 - 90.0) < 1.0
    assert told(AllEyed, tmp_path, sweep={"sensor": RIG}) == "[1, 0]"


def test_the_last_commanded_state_is_seen(tmp_path: Path) -> None:
    velocity, ahead = json.loads(told(Follower, tmp_path))
    np.testing.assert_allclose(velocity, [0.0, 2.0, 0.0], atol=0.3)
    assert 0.0 < np.linalg.norm(ahead) < 0.5  # the vehicle lags a little


def test_sweeps_of_a_lidar_are_seen(tmp_path: Path) -> None:
    rate_hz, is_deskewed, time_s, farthest_m = json.loads(told(Pointed, tmp_path, sweep={"sensor": "mid360_like"}))
    assert (rate_hz, is_deskewed) == (10.0, True)
    assert time_s == pytest.approx(0.2) and 1.0 < farthest_m < 70.1


def test_goals_are_seen_in_order(tmp_path: Path) -> None:
    goals = [[4.0, 8.0, 1.5], [7.0, 8.0, 2.5]]
    mission = {"list": [{"start": [2.0, 8.0, 1.5], "goals": goals}]}
    maps = {**HALL["maps"], "poisson_radius_m": 7.0}
    assert json.loads(told(Patrol, tmp_path, sweep={"mission": mission, "maps": maps})) == goals
    with pytest.raises(avoidbench.InputError, match="it does not declare AB_INPUT_GOALS"):
        told(OneEyed, tmp_path, sweep={"mission": mission})


def test_tracks_are_of_what_moves_around(tmp_path: Path) -> None:
    tracks = json.loads(told(Watcher, tmp_path, sweep={"movers": {"count": 9, "kind": "ball", "motion": "trefoil"}}))
    assert len(tracks) == 9 and len({track[0] for track in tracks}) == 9
    for _, kind, time_s, _, velocity, *size in tracks:
        assert kind == "ball" and time_s == pytest.approx(1.0, abs=0.051)
        assert 0.0 < np.linalg.norm(velocity) <= 2.0
        np.testing.assert_allclose(size, size[0], rtol=1e-3)
    assert told(Watcher, tmp_path) == "[]"


MISTAKES = {
    "divides": r"ZeroDivisionError: division by zero \(planners.py:\d+\)",
    "text": r"TypeError: plan\(\): expected a command or None, got str",
    "two_numbers": r"velocity_world_mps: expected an array of shape \(3,\), got \(2,\)",
    "nan": "velocity_world_mps is not finite",
    "two_yaws": "expected yaw_rad or yaw_rate_radps, got both",
    "one_point": "needs at least 2",
    "one_place": r"position_world_m: expected an array of shape \(2, 3\), got \(1, 3\)",
    "exits": "SystemExit",
}


def test_every_answer_ends_as_it_should(tmp_path: Path) -> None:
    flown = fly(Commanding, tmp_path, parameters={"answer": list(ANSWERS)}, jobs=2).trials
    trials = {trial.planner.split("=")[1].rstrip("]"): trial for trial in flown.itertuples()}
    assert trials.keys() == ANSWERS.keys()
    for answer, trial in trials.items():
        if answer in MISTAKES:
            assert trial.outcome == "planner_error", answer
            assert re.search(MISTAKES[answer], trial.reason), trial.reason
        elif answer == "gives_up":
            assert (trial.outcome, trial.reason) == ("planner_gave_up", "walled in")
        else:
            assert trial.outcome == "timed_out", trial.reason


def test_a_command_that_is_not_declared_is_an_error(tmp_path: Path) -> None:
    assert "does not declare" in only_trial(Undeclared, tmp_path)["reason"]


def test_wrong_declarations_are_refused(tmp_path: Path) -> None:
    class NoName(Planner):
        pass

    class Sees(Planner):
        name = "inputs"
        inputs = ("lidar",)

    class Uses(Planner):
        name = "uses"
        uses = ("files",)

    class Text(Planner):
        name = "text"
        commands = "velocity"

    class Kind(Planner):
        name = "kind"
        parameters = (Parameter("a", True, "Neither number nor text."),)

    class Inner(Planner):
        name = "inner"

    for planner, error, words in (
        (NoName, ValueError, "NoName.name: expected a text of a-z 0-9 _, got None"),
        (Sees, ValueError, "Sees.inputs: expected words of state, .*, got 'lidar'"),
        (Uses, ValueError, "expected words of processes, .*, got 'files'"),
        (Text, TypeError, "expected a list of words"),
        (Kind, TypeError, "parameter a: expected a number or a text as its preset, got bool"),
        (Inner, ValueError, "expected a class at the top level of its file, got .*<locals>.Inner"),
        (Preset, avoidbench.InputError, "the preset is outside"),
        (int, TypeError, "expected a subclass of avoidbench.Planner, got <class 'int'>"),
    ):
        with pytest.raises(error, match=words):
            fly(planner, tmp_path)
    with pytest.raises(avoidbench.InputError, match="line_gain_hz"):
        fly(StraightLine, tmp_path, parameters={"line_gain": 1.0})
    with pytest.raises(avoidbench.InputError, match="poisson_radius_m"):
        fly(StraightLine, tmp_path, sweep={"maps": {"generator": "hall", "poisson_radius_m": -1, "seeds": [1]}})
    # What only the program's own look at the file finds.
    file = tmp_path / "lidar.py"
    file.write_text("from avoidbench import Planner\nclass A(Planner):\n    name, inputs = 'a', ('lidar',)\n")
    with pytest.raises(
        avoidbench.ProgramError, match="lidar.py does not describe itself: ValueError: A.inputs: expected"
    ):
        avoidbench.run({**HALL, "planners": [str(file)]}, database=tmp_path / "flown.db", progress=False)


def test_the_next_call_flies_what_is_missing(tmp_path: Path) -> None:
    first = fly(StraightLine, tmp_path, sweep={"trials": 2})
    before = first.trials["trial_key"].tolist()
    again = fly(StraightLine, tmp_path, sweep={"trials": 2})
    assert again.trials["trial_key"].tolist() == before
    assert fly(StraightLine, tmp_path, label="mine").trials["planner"].tolist() == ["mine"]


CELL = """
from avoidbench.planner import Planner, Velocity

class Celled(Planner):
    name = "celled"

    def plan(self, observation):
        return Velocity([0.0, 0.0, 0.0])
"""


def test_a_class_of_a_notebook_is_flown_from_its_cell(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    notebook = types.ModuleType("a_notebook")
    monkeypatch.setitem(sys.modules, "a_notebook", notebook)
    exec(compile(CELL, "<cell 1>", "exec"), vars(notebook))
    with pytest.raises(ValueError, match="its source can't be found"):
        fly(notebook.Celled, tmp_path)
    monkeypatch.setitem(linecache.cache, "<cell 1>", (len(CELL), None, CELL.splitlines(keepends=True), "<cell 1>"))
    # One of another cell, which is not in the way.
    exec(compile(CELL.replace("Celled", "Other"), "<cell 2>", "exec"), vars(notebook))
    assert only_trial(notebook.Celled, tmp_path)["outcome"] == "timed_out"


def test_a_file_that_flies_while_it_is_imported_is_told(tmp_path: Path) -> None:
    script = tmp_path / "careless.py"
    script.write_text(f"import avoidbench\n{CELL}\navoidbench.fly('quick', Celled, progress=False)\n")
    done = subprocess.run([sys.executable, str(script)], cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert done.returncode == 1
    assert "call it under if __name__ == '__main__'" in done.stderr
    assert "InputError" in done.stderr and not (tmp_path / "results").exists()
