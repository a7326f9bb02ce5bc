"""Planners written in Python: the interface's structs, bits, mistakes."""

import ctypes
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import avoidbench
import numpy as np
import pytest
from avoidbench import _core, planner_abi, portable_math
from avoidbench.planner import (
    Acceleration,
    GiveUp,
    Mission,
    Observation,
    Parameter,
    Planner,
    Position,
    Rates,
    Setup,
    Trajectory,
    Velocity,
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


def fly(planner: type[Planner], folder: Path, **changes: Any) -> Any:
    return avoidbench.fly(
        {**HALL, **changes.pop("sweep", {})}, planner, database=folder / "flown.db", progress=False, **changes
    )


def only_trial(planner: type[Planner], folder: Path, **changes: Any) -> Any:
    trials = fly(planner, folder, **changes).trials
    assert len(trials) == 1
    return trials.iloc[0]


def test_structs_are_those_of_the_header() -> None:
    assert {name: ctypes.sizeof(struct) for name, struct in planner_abi.STRUCTS.items()} == _core.struct_sizes()


def test_portable_math_is_close_to_pythons() -> None:
    import math

    for name in portable_math.__all__:
        arguments = (0.3, -0.7) if name == "atan2" else (0.3,)
        assert getattr(portable_math, name)(*arguments) == pytest.approx(getattr(math, name)(*arguments), rel=1e-15)


def test_straight_line_in_python_flies_the_librarys_rows(tmp_path: Path) -> None:
    own = avoidbench.fly("quick", StraightLine, database=tmp_path / "own.db", progress=False)
    with pytest.warns(UserWarning, match="4 trials per map"):
        library = avoidbench.run(
            "quick", set={"planners": ["straight_line"]}, database=tmp_path / "library.db", progress=False
        )
    assert len(own.trials) == 8
    comparison = library.compare(own, exact=True)
    assert "bit for bit" in str(comparison)
    for key_own, key in zip(own.trials["trial_key"], library.trials["trial_key"], strict=True):
        assert key_own != key, "another file is another planner"
        np.testing.assert_array_equal(own.trajectory(key_own).to_numpy(), library.trajectory(key).to_numpy())


class Seeing(Planner):
    name = "seeing"
    sees = ("state", "depth", "stereo", "color", "imu")
    parameters = (
        Parameter("count", 3, "Whole.", lowest=1, highest=9),
        Parameter("word", "safe", "One of.", choices=("safe", "fast")),
        Parameter("text", "none", "Any."),
        Parameter("gain", 0.5, "Real."),
    )
    setups: list[Setup] = []
    missions: list[Mission] = []
    seen: list[dict[str, Any]] = []

    def __init__(self, setup: Setup) -> None:
        super().__init__(setup)
        Seeing.setups.append(setup)

    def reset(self, mission: Mission) -> None:
        Seeing.missions.append(mission)

    def plan(self, observation: Observation) -> Velocity:
        assert observation.imu is not None
        image = observation.depth[0]
        with pytest.raises(ValueError, match="read-only"):
            image.depth_m[0, 0] = 1.0
        Seeing.seen.append(
            {
                "time_s": observation.time_s,
                "depth": image.depth_m.copy(),
                "left": observation.stereo[0].left.pixels.shape,
                "color": observation.color[0].pixels.shape,
                "imu": observation.imu.specific_force_body_mps2.copy(),
                "place": observation.position_world_m,
                "camera": (image.position_world_m, image.q_world_camera),
            }
        )
        return Velocity([0.0, 0.0, 0.0])


def test_what_is_seen(tmp_path: Path) -> None:
    trial = only_trial(Seeing, tmp_path, parameters={"count": 4, "word": "fast", "gain": 0.25})
    assert trial["outcome"] == "timed_out"
    setup, mission = Seeing.setups[-1], Seeing.missions[-1]
    assert setup.parameters == {"count": 4, "word": "fast", "text": "none", "gain": 0.25}
    assert (setup.cameras[0].width_px, setup.cameras[0].height_px) == (24, 16)
    assert setup.plan_period_s == pytest.approx(1 / 30)
    assert mission.time_limit_s == 2.0
    assert len(Seeing.seen) == 60
    first = Seeing.seen[0]
    np.testing.assert_array_equal(first["place"], mission.start_world_m)
    np.testing.assert_allclose(Seeing.seen[30]["imu"][-1], [0.0, 0.0, 9.81], atol=0.5)
    assert first["left"] == (16, 24) and first["color"] == (16, 24, 3)
    world = avoidbench.make_world("hall", seed=1, area_m=[14, 16], poisson_radius_m=4.0)
    position, (w, x, y, z) = first["camera"]
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, 3] = position
    expected = world.depth(pose, sensor={"preset": "depth_ideal", "width_px": 24, "height_px": 16})
    np.testing.assert_allclose(first["depth"], expected, rtol=1e-4)


class OneEyed(Planner):
    """Stands; keeps what its camera shows."""

    name = "one_eyed"
    sees = ("state", "depth", "one_camera")
    least_fov_rad = (1.0, 0.5)
    yaws: list[float] = []

    def plan(self, observation: Observation) -> Velocity:
        assert len(self.setup.cameras) == 1
        image = observation.newest_depth(0)
        assert (
            observation.newest_depth(1) is None
            and observation.newest_color(0) is None
            and observation.newest_stereo(0) is None
        )
        if image is not None:
            w, x, y, z = image.q_world_camera
            ahead = (2 * (x * z + w * y), 2 * (y * z - w * x))
            OneEyed.yaws.append(float(np.degrees(np.arctan2(ahead[1], ahead[0]))))
        return Velocity([0.0, 0.0, 0.0])


class AllEyed(Planner):
    """Stands; counts the images of each camera."""

    name = "all_eyed"
    sees = ("state", "depth")
    seen: list[tuple[int, ...]] = []

    def plan(self, observation: Observation) -> Velocity:
        for camera in range(len(self.setup.cameras)):
            image = observation.newest_depth(camera)
            assert image is None or image.camera == camera
        AllEyed.seen.append(tuple(image.camera for image in observation.depth))
        return Velocity([0.0, 0.0, 0.0])


RIG = {"preset": "depth_ideal", "width_px": 24, "height_px": 16, "more_mountings": [{"yaw_deg": 90}]}


def test_a_planner_of_one_camera_is_given_one(tmp_path: Path) -> None:
    with pytest.raises(
        avoidbench.InputError, match=r"one_eyed can't fly with sensor 'depth_ideal': it handles one camera and gets 2"
    ):
        only_trial(OneEyed, tmp_path, sweep={"sensor": RIG})
    with pytest.raises(avoidbench.InputError, match=r"needs a view of 57.3° × 28.6° or more"):
        only_trial(OneEyed, tmp_path, sweep={"sensor": {**RIG, "more_mountings": [], "fov_x_deg": 50}})
    turns = []
    for camera in (0, 1):
        OneEyed.yaws.clear()
        only_trial(OneEyed, tmp_path, sweep={"sensor": RIG}, camera=camera, label=f"eye{camera}")
        turns.append(OneEyed.yaws[-1])
    assert abs((turns[1] - turns[0]) % 360.0 - 90.0) < 1.0
    only_trial(AllEyed, tmp_path, sweep={"sensor": RIG})
    assert AllEyed.seen[-1] == (1, 0)


class Commanding(Planner):
    name = "commanding"
    commands = ("position", "velocity", "acceleration", "trajectory", "rates")
    answer: Any = None

    def plan(self, observation: Observation) -> Any:
        return Commanding.answer(self, observation)


HOLD = [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    "answer",
    [
        lambda self, seen: Position(seen.position_world_m + [0, 0, 0.1], yaw_rad=0.1),
        lambda self, seen: Velocity(HOLD, yaw_rate_radps=0.2, horizon_s=0.5),
        lambda self, seen: Acceleration(np.array([0.0, 0.1, 0.0], np.float32)),
        lambda self, seen: Rates([0, 0, 0], 9.81),
        lambda self, seen: Trajectory(
            [0.0, 0.5], [seen.position_world_m, seen.position_world_m], [HOLD, HOLD], [HOLD, HOLD], yaw_rad=[0.1, 0.2]
        ),
        lambda self, seen: None,
    ],
)
def test_every_command_flies(answer: Any, tmp_path: Path) -> None:
    Commanding.answer = answer
    assert only_trial(Commanding, tmp_path)["outcome"] == "timed_out"


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        (lambda self, seen: 1 / 0, r"ZeroDivisionError: division by zero \(test_planner.py:\d+\)"),
        (lambda self, seen: "left", "TypeError: plan\\(\\) gave str, which is no command"),
        (lambda self, seen: Velocity([1, 2]), "velocity_world_mps: an array \\(3,\\) is wanted, not \\(2,\\)"),
        (lambda self, seen: Velocity([1, 2, float("nan")]), "velocity_world_mps is not finite"),
        (lambda self, seen: Velocity(HOLD, yaw_rad=0.0, yaw_rate_radps=0.0), "one of the two is wanted"),
        (lambda self, seen: Trajectory([0.0], [HOLD], [HOLD], [HOLD]), "needs at least 2"),
        (lambda self, seen: Trajectory([0.0, 1.0], [HOLD], [HOLD], [HOLD]), "position_world_m: an array \\(2, 3\\)"),
        (lambda self, seen: sys.exit(3), "SystemExit"),
    ],
)
def test_mistakes_end_the_trial_with_their_reason(answer: Any, reason: str, tmp_path: Path) -> None:
    import re

    Commanding.answer = answer
    trial = only_trial(Commanding, tmp_path)
    assert trial["outcome"] == "planner_error"
    assert re.search(reason, trial["reason"]), trial["reason"]


def test_giving_up_is_an_outcome(tmp_path: Path) -> None:
    def answer(self: Planner, seen: Observation) -> None:
        raise GiveUp("walled in")

    Commanding.answer = answer
    trial = only_trial(Commanding, tmp_path)
    assert (trial["outcome"], trial["reason"]) == ("planner_gave_up", "walled in")


def test_a_command_that_is_not_declared_is_an_error(tmp_path: Path) -> None:
    class Undeclared(Planner):
        name = "undeclared"

        def plan(self, observation: Observation) -> Position:
            return Position(observation.position_world_m)

    assert "does not declare" in only_trial(Undeclared, tmp_path)["reason"]


def test_wrong_declarations_are_refused(tmp_path: Path) -> None:
    class NoName(Planner):
        pass

    class Sees(Planner):
        name = "sees"
        sees = ("lidar",)

    class Uses(Planner):
        name = "uses"
        uses = ("files",)

    class Text(Planner):
        name = "text"
        commands = "velocity"

    class Preset(Planner):
        name = "preset"
        parameters = (Parameter("a", 3.0, "Beyond its range.", lowest=0, highest=1),)

    for planner, error, words in (
        (NoName, ValueError, "NoName.name"),
        (Sees, ValueError, "'lidar' is none of"),
        (Uses, ValueError, "'files' is none of processes"),
        (Text, TypeError, "a list"),
        (Preset, avoidbench.InputError, "the preset is outside"),
        (int, TypeError, "a subclass of"),
    ):
        with pytest.raises(error, match=words):
            fly(planner, tmp_path)
    with pytest.raises(avoidbench.InputError, match="line_gain_hz"):
        fly(StraightLine, tmp_path, parameters={"line_gain": 1.0})
    with pytest.raises(avoidbench.InputError, match="poisson_radius_m"):
        fly(StraightLine, tmp_path, sweep={"maps": {"generator": "hall", "poisson_radius_m": -1, "seeds": [1]}})


def test_the_next_call_flies_what_is_missing(tmp_path: Path) -> None:
    first = fly(StraightLine, tmp_path, sweep={"trials": 2})
    before = first.trials["trial_key"].tolist()
    again = fly(StraightLine, tmp_path, sweep={"trials": 2})
    assert again.trials["trial_key"].tolist() == before
    assert fly(StraightLine, tmp_path, label="mine").trials["planner"].tolist() == ["mine"]


INTERRUPTED = """
import os, signal, sys, time
sys.path.insert(0, {examples!r})
import avoidbench
from straight_line import StraightLine
class Slow(StraightLine):
    name = "slow"
    def plan(self, seen):
        if seen.time_s > 0.3: os.kill(os.getpid(), signal.SIGINT)
        return super().plan(seen)
try:
    avoidbench.fly({sweep!r}, Slow, database={database!r}, progress=False)
except KeyboardInterrupt:
    sys.exit(7)
"""


def test_an_interrupt_ends_after_the_trial_that_flies(tmp_path: Path) -> None:
    script = tmp_path / "interrupted.py"
    database = tmp_path / "flown.db"
    script.write_text(INTERRUPTED.format(examples=str(EXAMPLES), sweep={**HALL, "trials": 5}, database=str(database)))
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 7, done.stderr
    trials = avoidbench.read(database).trials
    assert len(trials) == 1
    assert trials.iloc[0]["outcome"] in ("timed_out", "reached_goal", "collided")
    assert (
        signal.getsignal(signal.SIGINT) is signal.default_int_handler
        or os.environ.get("PYTEST_XDIST_WORKER") is not None
    )


def test_a_class_without_a_file_is_refused(tmp_path: Path) -> None:
    names: dict[str, Any] = {}
    exec("from avoidbench.planner import Planner\nclass Nowhere(Planner):\n    name = 'nowhere'", names)
    names["Nowhere"].__module__ = "nowhere_at_all"
    with pytest.raises(ValueError, match="its source is not to be had"):
        fly(names["Nowhere"], tmp_path)
