#!/usr/bin/env python3
"""check_files.py BRIDGE: topics files for real nodes, each problem with its place; ${…}; and what command messages
become. Without ROS: messages are stand-ins with their members. Exit code 77: no NumPy or PyYAML here."""

import importlib.util
import math
import os
import pathlib
import shutil
import sys
import tempfile
from types import SimpleNamespace as Of

SYSTEM_PYTHON = "/usr/bin/python3"
if any(importlib.util.find_spec(name) is None for name in ("numpy", "yaml")):
    if os.access(SYSTEM_PYTHON, os.X_OK) and not sys.executable.startswith(SYSTEM_PYTHON):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, "-B", *sys.argv])
    print("passed over: this Python lacks NumPy or PyYAML")
    sys.exit(77)
import numpy as np  # noqa: E402

bridge = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(bridge))
from avoidbench.planner import Acceleration, Camera, Lidar, Mission, Position, Rates, Setup, Trajectory, Velocity  # noqa: E402
from commands import Commands, SetPoint  # noqa: E402
from live_file import LiveFile, Problem, evaluated, given_by  # noqa: E402

failures = []
GOOD = """nodes:
  - name: one
    run: ./node.py
    params: {gain: "${2 * max_speed_mps}", far: "${goal_x_m - start_x_m}", f: "${fx_px / 2}", deep: {list: [1, "${round(2.5)}"]},
             most: "${floor(1e308 * 10)}", above: "${lidar_z_m}", sees: "${lidar_max_range_m}"}
publish:
  odometry: {topic: /odom}
command: {topic: /cmd, type: geometry_msgs/Twist}
live: {name: mine}
"""
# (what is replaced, by what) -> the problem
BAD = {
    ("live: {name: mine}", "live: {name: Mine}"): '9:14: "Mine" is no name of a planner',
    ("live: {name: mine}", "live: {clock_rat: 2}"): '9:8: there is no "clock_rat" here; did you mean clock_rate?',
    ("live: {name: mine}", "live: {clock_step_s: 0}"): "9:22: 0 is not from 0.001 to 1.0",
    ("live: {name: mine}", "live: {restart: always}"): '9:17: "always" is none of trial, never',
    ("live: {name: mine}", "live: {master: running}"): "3:10: with master: running somebody else starts the nodes",
    ("    run: ./node.py\n", ""): "1:1: nothing starts a node here: ",
    ("./node.py", "./nod.py"): "3:10: there is no program ",
    ("./node.py", "no-such-program"): "3:10: there is no program no-such-program on the PATH",
    ("run: ./node.py", "run: ./node.py 'one"): "3:10: this is no command: No closing quotation",
    ("run: ./node.py", "run: []"): "3:10: a command stands here",
    ("run: ./node.py", "rum: ./node.py"): '3:5: there is no "rum" here; did you mean run?',
    ("max_speed_mps}", "max_sped_mps}"): '4:20: "max_sped_mps" is nothing that a trial gives: ',
    ("  odometry:", "  odometri:"): '7:3: "odometri" is none of odometry, ',
    ("geometry_msgs/Twist", "geometry_msgs/Point"): "8:30: Point is none of PositionCommand, ",
}


def expect(what, is_so, found=""):
    if not is_so:
        failures.append(f"{what}: {found}")


def vector(x, y, z):
    return Of(x=x, y=y, z=z)


def files(folder):
    (folder / "node.py").write_text("#!/bin/sh\n")
    (folder / "node.py").chmod(0o755)
    topics = folder / "topics.yaml"
    for (old, new), problem in BAD.items():
        expect(f"{old!r} is in the topics", old in GOOD)
        topics.write_text(GOOD.replace(old, new))
        try:
            LiveFile(topics)
            expect(f"{new!r}", False, "no problem is told")
        except Problem as told:
            expect(f"{new!r}: {problem}", str(told).startswith(f"{topics}:{problem}"), told)
    topics.write_text(GOOD)
    file = LiveFile(topics)
    expect(
        "a name", file.live.name == "mine" and file.nodes[0].words == ["./node.py", "__name:=one"], file.nodes[0].words
    )
    expect("files", file.decisive_files() == ["node.py"], file.decisive_files())
    camera = Camera(160, 120, 100.0, 100.0, 80.0, 60.0, np.zeros(3), np.array([1.0, 0, 0, 0]), 30.0, 0.3, 20.0, 0.1)
    lidar = Lidar(True, np.array([0.0, 0.0, 0.1]), np.array([1.0, 0, 0, 0]), 10.0, 0.5, 100.0, -0.3, 0.3, 28800)
    setup = Setup({}, 3.0, 5.0, 1.5, np.array([0.4, 0.4, 0.2]), 0.3, 0.05, 9.81, (camera,), (lidar,))
    goal = np.array([11.0, 2.0, 2.0])
    mission = Mission(7, np.array([1.0, 2.0, 2.0]), 0.0, goal, 1.0, 60.0, np.zeros(3), np.ones(3), 0.033, goal[None])
    given = given_by(setup, mission)
    values = {name: evaluated(value, given, []) for name, value in file.leaves}
    wanted = {"/one/gain": 6.0, "/one/far": 10.0, "/one/f": 50.0, "/one/deep/list": [1, 3.0], "/one/most": math.inf}
    wanted |= {"/one/above": 0.1, "/one/sees": 100.0}
    expect("values", values == wanted and all(type(one) in (float, list) for one in values.values()), values)
    shutil.copytree(bridge / "example", folder / "example")
    example = LiveFile(folder / "example/topics.yaml")
    expect(
        "the example",
        set(example.inputs) == {"state", "depth", "goals"}
        and example.decisive_files() == ["flyer.py"]
        and not example.notes,
    )
    topics.write_text(
        GOOD.replace("run:", "main: one\n    run:").replace(
            "geometry_msgs/Twist}", "own_msgs/Set, form: PositionCommand}"
        )
    )
    notes = LiveFile(topics).notes
    expect(
        "what is for the shim alone is told",
        len(notes) == 1 and f"{topics}:3:11: main is for ros_shim alone" in notes[0],
        notes,
    )


def commands():
    def answer(form, message, now_s=10.0, stale_s=0.5, in_body=False, taken_s=10.0, yaw=0.0):
        spec = Of(form=form, in_body=in_body, stale_s=stale_s, hover_thrust=0.5)
        made = Commands(spec, 0.1, 10.0)
        made.take(message, round(1e9 * taken_s))
        return made.answer(round(1e9 * now_s), (math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)))

    twist = Of(linear=vector(1.0, 0.0, 0.5), angular=vector(0, 0, 0.3))
    found = answer("Twist", twist)
    expect(
        "a twist",
        isinstance(found, Velocity) and list(found.velocity_world_mps) == [1, 0, 0.5] and found.yaw_rate_radps == 0.3,
        found,
    )
    found = answer("TwistStamped", Of(twist=twist), in_body=True, yaw=math.pi / 2)
    expect("in the heading's frame", np.allclose(found.velocity_world_mps, [0, 1, 0.5]), found)
    expect("too old", answer("Twist", twist, now_s=10.6) is None)
    upright = Of(x=0.0, y=0.0, z=math.sin(0.2), w=math.cos(0.2))
    found = answer("PoseStamped", Of(pose=Of(position=vector(1, 2, 3), orientation=upright)))
    expect(
        "a pose",
        isinstance(found, Position) and list(found.position_world_m) == [1, 2, 3] and abs(found.yaw_rad - 0.4) < 1e-12,
        found,
    )
    point = Of(position=vector(1, 0, 2), velocity=vector(2, 0, 0), acceleration=vector(1, 0, 0), yaw=0.1, yaw_dot=0.2)
    found = answer("PositionCommand", point, now_s=10.1)
    expect(
        "a set point, brought to now",
        isinstance(found, Trajectory)
        and list(found.time_s) == [0.0, 0.2]
        and np.allclose(found.position_world_m, [[1.205, 0, 2], [1.645, 0, 2]])
        and np.allclose(found.velocity_world_mps[:, 0], [2.1, 2.3])
        and np.allclose(found.yaw_rad, [0.12, 0.16]),
        found,
    )
    target = Of(
        type_mask=7 | 56 | 2048,
        coordinate_frame=1,
        position=vector(0, 0, 0),
        velocity=vector(0, 0, 0),
        acceleration_or_force=vector(1, 2, 3),
        yaw=0.5,
        yaw_rate=0.0,
    )
    found = answer("PositionTarget", target)
    expect(
        "a target",
        isinstance(found, Acceleration) and list(found.acceleration_world_mps2) == [1, 2, 3] and found.yaw_rad == 0.5,
        found,
    )
    found = answer("AttitudeTarget", Of(type_mask=128, body_rate=vector(1, 2, 3), thrust=0.25))
    expect("rates", isinstance(found, Rates) and found.thrust_mps2 == 5.0, found)
    for form, message in (
        ("PositionTarget", Of(**{**vars(target), "type_mask": 512})),
        ("AttitudeTarget", Of(type_mask=1)),
    ):
        try:
            answer(form, message)
            expect(f"{form} that can't be flown", False)
        except ValueError:
            pass

    def at(second, x, yaw):
        turned = Of(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))
        return Of(
            transforms=[Of(translation=vector(x, 0, 2), rotation=turned)],
            velocities=[twist],
            accelerations=[],
            time_from_start=Of(to_nsec=lambda: round(1e9 * second)),
        )

    points = [at(0.0, 0.0, 3.1), at(0.5, 0.5, -3.1), at(0.51, 0.51, -3.1), at(1.0, 1.0, -3.0)]
    path = Of(header=Of(stamp=Of(to_nsec=lambda: 10**10)), points=points)
    found = answer("MultiDOFJointTrajectory", path, now_s=10.2, taken_s=9.0)
    expect(
        "a trajectory",
        np.allclose(found.time_s, [0.0, 0.3, 0.8])
        and np.allclose(found.position_world_m[:, 0], [0.2, 0.5, 1.0])
        and np.all(np.abs(np.diff(found.yaw_rad)) < 0.3),
        found,
    )
    expect("a motion", SetPoint(0, np.zeros(3)).after(1.0)[3:] == (0.0, 0.0))


with tempfile.TemporaryDirectory() as name:
    files(pathlib.Path(name))
commands()
print("\n".join(failures) if failures else "all as it should be")
sys.exit(1 if failures else 0)
