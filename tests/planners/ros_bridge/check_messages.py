#!/usr/bin/env python3
"""check_messages.py BRIDGE: sweeps of lidars as real messages of rospy, written to bytes and read back, without a
master: publishers are stand-ins. Exit code 77: no rospy here."""

import importlib.util
import io
import math
import os
import pathlib
import sys
import tempfile

SYSTEM_PYTHON = "/usr/bin/python3"
NEEDED = ("numpy", "yaml", "rospy", "sensor_msgs", "nav_msgs")
if any(importlib.util.find_spec(name) is None for name in NEEDED):
    if os.access(SYSTEM_PYTHON, os.X_OK) and not sys.executable.startswith(SYSTEM_PYTHON):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, "-B", *sys.argv])
    print("passed over: this Python lacks rospy, NumPy or PyYAML: scripts/install_packages.sh ros_live")
    sys.exit(77)
import numpy as np  # noqa: E402
import rospy  # noqa: E402

sys.path.insert(0, str(pathlib.Path(sys.argv[1])))
from avoidbench.planner import Camera, Cloud, Lidar, Mission, Observation, Setup  # noqa: E402
from live_file import LiveFile  # noqa: E402
from observations import Observations  # noqa: E402
from ros_processes import StartProblem  # noqa: E402
from sensor_msgs.msg import PointCloud2, PointField  # noqa: E402

TOPICS = """nodes:
  - {name: one, run: ["true"]}
publish:
  odometry: {topic: /odom}
  cloud:
    - {topic: /world, lidar: 1}
    - {topic: /body, lidar: 1, points_in: body, frame: base_link}
    - {topic: /lidar, lidar: 1, points_in: lidar, frame: velodyne}
    - {topic: /other, lidar: 0, points_in: lidar}
command: {topic: /cmd, type: geometry_msgs/Twist}
"""
UPRIGHT, LEFT, BACK = (np.array([math.cos(a / 2), 0.0, 0.0, math.sin(a / 2)]) for a in (0.0, math.pi / 2, math.pi))
BASE_NS = 200 * 10**9
failures = []


def expect(what, is_so, found=""):
    if not is_so:
        failures.append(f"{what}: {found}")


class Publisher:
    """Keeps what was published, of all, in order."""

    sent = []  # noqa: RUF012

    def __init__(self, topic, kind, **_):
        self.topic, self.kind = topic, kind

    def publish(self, message):
        # As TCP would bring it.
        stream = io.BytesIO()
        message.serialize(stream)
        self.sent.append((self.topic, self.kind().deserialize(stream.getvalue())))


def lidar_at(position_m, q):
    return Lidar(True, np.array(position_m), q, 10.0, 0.5, 100.0, -0.3, 0.3, 4)


def setup_with(lidars, cameras=()):
    return Setup({}, 3.0, 5.0, 1.5, np.array([0.4, 0.4, 0.2]), 0.3, 0.05, 9.81, cameras, lidars)


def sweep(lidar, time_s, points):
    """Met these points of (x, y, z, time, intensity), seen from (10, 20, 30), turned by 180° of yaw."""
    numbers = np.array(points, np.float32).reshape(-1, 5)
    misses = np.array([[1.0, 0.0, 0.0]], np.float32)
    place = np.array([10.0, 20.0, 30.0])
    return Cloud(time_s, numbers[:, :3], numbers[:, 3], numbers[:, 4], misses, place, BACK, lidar)


def observation(clouds):
    return Observation(
        time_s=0.5,
        position_world_m=np.zeros(3),
        velocity_world_mps=np.zeros(3),
        q_world_body=UPRIGHT,
        rates_body_radps=np.zeros(3),
        depth=(),
        stereo=(),
        color=(),
        imu=None,
        clouds=clouds,
    )


def read(cloud):
    """The numbers of a cloud, (N, 5)."""
    wanted = [("x", 0), ("y", 4), ("z", 8), ("intensity", 12), ("time", 16)]
    fields = [(one.name, one.offset) for one in cloud.fields]
    expect("the fields", fields == wanted and {one.datatype for one in cloud.fields} == {PointField.FLOAT32}, fields)
    sizes = (cloud.height, cloud.point_step, cloud.row_step, len(cloud.data))
    expect("the sizes", sizes == (1, 20, 20 * cloud.width, 20 * cloud.width), sizes)
    expect("all points are finite", cloud.is_dense and not cloud.is_bigendian)
    return np.frombuffer(cloud.data, "<f4").reshape(-1, 5)


def messages(topics):
    file = LiveFile(topics)
    expect("points are all that is seen beside the state", file.inputs == ("state", "points"), file.inputs)
    lidars = (lidar_at([0.0, 0.0, 0.0], UPRIGHT), lidar_at([0.1, 0.0, 0.2], LEFT))
    made = Observations(file.published, setup_with(lidars))
    goal = np.array([11.0, 2.0, 2.0])
    made.begin(BASE_NS, Mission(7, np.zeros(3), 0.0, goal, 1.0, 60.0, np.zeros(3), np.ones(3), 0.033, goal[None]))
    newest = sweep(1, 0.5, [[1.0, 2.0, 3.0, -0.04, 0.3], [0.0, 0.0, 0.5, 0.0, 0.7]])
    seen = observation((newest, sweep(0, 0.45, [[5.0, 0.0, 0.0, 0.0, 0.1]]), sweep(1, 0.4, [])))
    made.publish(seen, BASE_NS + 500_000_000)
    clouds = [(topic, one) for topic, one in Publisher.sent if isinstance(one, PointCloud2)]
    order = [topic for topic, _ in clouds]
    expect("oldest first, each on its topics", order == ["/world", "/body", "/lidar", "/other"] + order[:3], order)
    stamps = [one.header.stamp.to_nsec() - BASE_NS for _, one in clouds]
    expect("stamps are the sweeps' ends", stamps == [400_000_000] * 3 + [450_000_000] + [500_000_000] * 3, stamps)
    frames = [one.header.frame_id for _, one in clouds[:4]]
    expect("frames", frames == ["world", "base_link", "velodyne", "lidar"], frames)
    expect("a sweep that met nothing", clouds[0][1].width == 0 and len(read(clouds[0][1])) == 0)
    expect("of the other lidar", np.array_equal(read(clouds[3][1]), np.array([[5, 0, 0, 0.1, 0]], "<f4")))
    rest = [[0.3, -0.04], [0.7, 0.0]]
    # The lidar's x is the body's y, and its y the body's -x.
    places = {
        "/world": [[10.0 - 1.0, 20.0 - 2.0, 33.0], [10.0, 20.0, 30.5]],
        "/body": [[0.1 - 2.0, 1.0, 3.2], [0.1, 0.0, 0.7]],
        "/lidar": [[1.0, 2.0, 3.0], [0.0, 0.0, 0.5]],
    }
    for topic, cloud in clouds[4:]:
        numbers = read(cloud)
        expect(f"places on {topic}", np.allclose(numbers[:, :3], places[topic], atol=1e-5), numbers)
        expect(f"intensity and time on {topic}", np.array_equal(numbers[:, 3:], np.array(rest, "<f4")), numbers)


def problems(topics):
    def told(setup):
        try:
            Observations(LiveFile(topics).published, setup)
        except StartProblem as problem:
            return str(problem)
        return ""

    one = (lidar_at([0.0, 0.0, 0.0], UPRIGHT),)
    found = told(setup_with(one))
    expect(
        "a lidar too few",
        found == f"{topics}:6:15: /world: there is no lidar 1: the sensor has 1, counted from 0",
        found,
    )
    found = told(setup_with(()))
    expect("no lidar", found == f"{topics}:6:15: /world is of a lidar, and the sensor has none", found)
    topics.write_text(TOPICS.replace("/odom}", "/odom}\n  depth: {topic: /depth}"))
    found = told(setup_with(2 * one))
    expect("no camera", found == f"{topics}:5:18: /depth is of a camera, and the sensor has none", found)
    camera = Camera(160, 120, 100.0, 100.0, 80.0, 60.0, np.zeros(3), UPRIGHT, 30.0, 0.3, 20.0, 0.1)
    expect("a rig has both", told(setup_with(2 * one, (camera,))) == "")
    inputs = LiveFile(topics).inputs
    expect("both are seen", inputs == ("state", "depth", "points"), inputs)


rospy.Publisher = Publisher
with tempfile.TemporaryDirectory() as name:
    file = pathlib.Path(name) / "topics.yaml"
    file.write_text(TOPICS)
    messages(file)
    problems(file)
print("\n".join(failures) if failures else "all as it should be")
sys.exit(1 if failures else 0)
