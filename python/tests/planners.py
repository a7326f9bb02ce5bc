"""Planners that tests fly, several in one file. The program starts them, so what they saw they tell by giving up."""

import base64
import json
import math
import sys
from typing import Any

import numpy as np
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

HOLD = [0.0, 0.0, 0.0]


def plain(value: Any) -> Any:
    """For JSON."""
    return value.tolist() if isinstance(value, np.ndarray) else value


def is_writable(pixels: Any) -> bool:
    try:
        pixels[0, 0] = pixels[0, 0]
    except ValueError:
        return False
    return True


class Seeing(Planner):
    """Stands for 30 calls, and then tells what it was told first, and its newest samples."""

    name = "seeing"
    inputs = ("state", "depth", "stereo", "color", "imu", "states")
    parameters = (
        Parameter("count", 3, "Whole.", lowest=1, highest=9),
        Parameter("word", "safe", "One of.", choices=("safe", "fast")),
        Parameter("text", "Grüße", "Any."),
        Parameter("gain", 0.5, "Real."),
    )

    def reset(self, mission: Mission) -> None:
        self.calls = 0
        self.told = {f"mission.{name}": plain(value) for name, value in vars(mission).items()}
        self.told["parameters"] = dict(self.setup.parameters)
        self.told["plan_period_s"] = self.setup.plan_period_s
        self.told["size_px"] = [self.setup.cameras[0].width_px, self.setup.cameras[0].height_px]

    def plan(self, observation: Observation) -> Velocity:
        assert observation.imu is not None
        self.calls += 1
        if self.calls == 1:
            image, pair, picture = observation.depth[0], observation.stereo[0], observation.color[0]
            self.told["place"] = observation.position_world_m.tolist()
            self.told["camera"] = [image.position_world_m.tolist(), image.q_world_camera.tolist()]
            self.told["depth"] = base64.b64encode(image.depth_m.tobytes()).decode()
            self.told["left"], self.told["color"] = pair.left.pixels.shape, picture.pixels.shape
            self.told["eyes_m"] = (pair.right.position_world_m - pair.left.position_world_m).tolist()
            self.told["baseline_m"] = pair.baseline_m
            self.told["is_writable"] = is_writable(image.depth_m)
        if self.calls == 31:
            self.told["imu"] = observation.imu.specific_force_body_mps2[-1].tolist()
            self.told["state_times_s"] = [state.time_s for state in observation.states]
            self.told["imu_times_s"] = observation.imu.time_s.tolist()
            self.told["times_s"] = [observation.time_s, observation.call_time_s]
            raise GiveUp(json.dumps(self.told))
        return Velocity(HOLD)


class OneEyed(Planner):
    """Tells where its camera looks."""

    name = "one_eyed"
    inputs = ("state", "depth", "one_camera")
    least_fov_rad = (1.0, 0.5)

    def plan(self, observation: Observation) -> Velocity:
        image = observation.newest_depth(0)
        assert len(self.setup.cameras) == 1 and observation.newest_depth(1) is None
        assert observation.newest_color(0) is None and observation.newest_stereo(0) is None
        assert image is not None
        w, x, y, z = image.q_world_camera
        raise GiveUp(str(math.degrees(math.atan2(2 * (y * z - w * x), 2 * (x * z + w * y)))))


class Follower(Planner):
    """Tells where it was told to be after a second at 2 m/s."""

    name = "follower"
    inputs = ("state", "reference")

    def plan(self, observation: Observation) -> Velocity:
        reference = observation.reference
        assert reference is not None and reference.time_s == observation.call_time_s
        if reference.time_s > 1.0:
            ahead = np.asarray(reference.position_world_m) - np.asarray(observation.position_world_m)
            raise GiveUp(json.dumps([reference.velocity_world_mps.tolist(), ahead.tolist()]))
        return Velocity((0.0, 2.0, 0.0))


class Pointed(Planner):
    """Tells of its lidar's second sweep."""

    name = "pointed"
    inputs = ("state", "points")

    def plan(self, observation: Observation) -> Velocity:
        lidar = self.setup.lidars[0]
        cloud = observation.newest_cloud(0)
        if cloud is not None and cloud.time_s > 0.15:
            assert len(cloud.points_lidar_m) + len(cloud.misses_lidar) == lidar.shots
            assert -0.1 < cloud.point_times_s.min() and cloud.point_times_s.max() <= 0
            assert 0 < cloud.intensities.min() and cloud.intensities.max() <= 1
            assert not cloud.points_lidar_m.flags.writeable and not self.setup.cameras
            ranges = np.linalg.norm(cloud.points_lidar_m, axis=1)
            raise GiveUp(json.dumps([lidar.rate_hz, lidar.is_deskewed, cloud.time_s, float(ranges.max())]))
        return Velocity(HOLD)


class Patrol(Planner):
    """Tells which goals it was shown, and where, once it has seen the last one."""

    name = "patrol"
    inputs = ("state", "goals")

    def reset(self, mission: Mission) -> None:
        self.goals_world_m = mission.goals_world_m
        assert (mission.goals_world_m[0] == mission.goal_world_m).all()

    def plan(self, observation: Observation) -> Velocity:
        goal = observation.goal_world_m
        assert goal is not None and (goal == self.goals_world_m[observation.goal_index]).all()
        if observation.goal_index + 1 == len(self.goals_world_m):
            raise GiveUp(json.dumps(self.goals_world_m.tolist()))
        return Velocity(goal - observation.position_world_m)


class Watcher(Planner):
    """Tells of the tracks after a second."""

    name = "watcher"
    inputs = ("state", "tracks")

    def plan(self, observation: Observation) -> Velocity:
        if observation.call_time_s > 1.0:
            raise GiveUp(
                json.dumps(
                    [
                        [t.id, t.kind, t.time_s, t.center_world_m.tolist(), t.velocity_world_mps.tolist()]
                        + t.size_m.tolist()
                        for t in observation.tracks
                    ]
                )
            )
        return Velocity((0.0, 0.0, 0.0))


class AllEyed(Planner):
    """Tells of which cameras it has images."""

    name = "all_eyed"
    inputs = ("state", "depth")

    def plan(self, observation: Observation) -> Velocity:
        for camera in range(len(self.setup.cameras)):
            image = observation.newest_depth(camera)
            assert image is not None and image.camera == camera
        raise GiveUp(str([image.camera for image in observation.depth]))


def gives_up(seen: Observation) -> None:
    raise GiveUp("walled in")


ANSWERS: dict[str, Any] = {
    "position": lambda seen: Position(seen.position_world_m + [0, 0, 0.1], yaw_rad=0.1),
    "velocity": lambda seen: Velocity(HOLD, yaw_rate_radps=0.2, horizon_s=0.5),
    "acceleration": lambda seen: Acceleration(np.array([0.0, 0.1, 0.0], np.float32)),
    "rates": lambda seen: Rates([0, 0, 0], 9.81),
    "trajectory": lambda seen: Trajectory(
        [0.0, 0.5], [seen.position_world_m, seen.position_world_m], [HOLD, HOLD], [HOLD, HOLD], yaw_rad=[0.1, 0.2]
    ),
    "none": lambda seen: None,
    "gives_up": gives_up,
    "divides": lambda seen: 1 / 0,
    "text": lambda seen: "left",
    "two_numbers": lambda seen: Velocity([1, 2]),
    "nan": lambda seen: Velocity([1, 2, float("nan")]),
    "two_yaws": lambda seen: Velocity(HOLD, yaw_rad=0.0, yaw_rate_radps=0.0),
    "one_point": lambda seen: Trajectory([0.0], [HOLD], [HOLD], [HOLD]),
    "one_place": lambda seen: Trajectory([0.0, 1.0], [HOLD], [HOLD], [HOLD]),
    "exits": lambda seen: sys.exit(3),
}


class Commanding(Planner):
    """Gives one answer again and again."""

    name = "commanding"
    commands = ("position", "velocity", "acceleration", "trajectory", "rates")
    parameters = (Parameter("answer", "none", "What it gives.", choices=tuple(ANSWERS)),)

    def __init__(self, setup: Setup) -> None:
        self.answer = ANSWERS[setup.parameters["answer"]]

    def plan(self, observation: Observation) -> Any:
        return self.answer(observation)


class Undeclared(Planner):
    name = "undeclared"

    def plan(self, observation: Observation) -> Position:
        return Position(observation.position_world_m)


class Preset(Planner):
    name = "preset"
    parameters = (Parameter("a", 3.0, "Beyond its range.", lowest=0, highest=1),)
