#!/usr/bin/env python3
"""Flights of real ROS 1 nodes, with real masters and real TCP.

    live_flights.py PROGRAM SOURCES [--only PART]

The example reaches its goals with two workers that never hear each other; all that can be published is heard; nodes
that end, or are ended, cost their own trials; a launch file and a master that runs already; nothing is left: no
process, no file. Exit code 77: no rospy here."""

import argparse
import os
import pathlib
import shutil
import signal
import sqlite3
import stat
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent.parent / "program_planner"))
from program_runs import Runs  # noqa: E402

PYTHON = "/usr/bin/python3"
HEAD = """
sweep: live
maps: {generator: hall, area_m: [12, 14], poisson_radius_m: [5], seeds: [1]}
trials: TRIALS
vehicle: hummingbird
sensor: {preset: depth_ideal, width_px: 160, height_px: 120}
latency: {mode: fixed, ms: 33}
mission: {time_limit_s: 40}
planners:
"""
TOPICS = """
summary: A node of the test.
nodes:
  - {name: node, run: [./node.py, WAY]}
publish:
  odometry: {topic: /odom}
  goal: {topic: /goal}
command: {topic: /cmd_vel, type: geometry_msgs/TwistStamped}
live: {name: WAY, clock_rate: 10, start_wait_s: 15}
"""
# Flies straight at the goal, for a while.
NODE = f"""#!{PYTHON}
import os, signal, sys
import rospy
from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry

WAY = sys.argv[1]
heard = 0
publisher = goal = None


def take_goal(message):
    global goal
    goal = message.pose.position


def take(message):
    global heard
    heard += message.header.stamp.to_sec() > 0 and goal is not None
    if heard == 30 and WAY == "exits":
        print("first words\\nlast words", flush=True)
        os._exit(3)
    if heard == 30 and WAY == "segfault":
        os.kill(os.getpid(), signal.SIGSEGV)
    if heard and WAY != "silent":
        p, command = message.pose.pose.position, TwistStamped()
        command.header.stamp = message.header.stamp
        command.twist.linear.x, command.twist.linear.y = [max(-0.7, min(0.7, b - a)) for a, b in ((p.x, goal.x), (p.y, goal.y))]
        publisher.publish(command)


rospy.init_node("node")
if WAY == "writes":
    open("left_behind", "w")
publisher = rospy.Publisher("/cmd_vel", TwistStamped, queue_size=1)
rospy.Subscriber("/goal", PoseStamped, take_goal)
rospy.Subscriber("/odom", Odometry, take)
rospy.spin()
"""
# Ends with exit code 9 when it hears another flight: a second publisher, or odometry that jumps.
WATCHER = f"""#!{PYTHON}
import math, os, time
import rosgraph
import rospy
from nav_msgs.msg import Odometry

last = None


def take(message):
    global last
    p = message.pose.pose.position
    if last is not None and math.dist(last, (p.x, p.y, p.z)) > 0.5:
        print("the odometry jumps", flush=True)
        os._exit(9)
    last = (p.x, p.y, p.z)


rospy.init_node("watcher")
rospy.Subscriber("/odom", Odometry, take)
while not rospy.is_shutdown():
    publishers, _, _ = rosgraph.Master("/watcher").getSystemState()
    nodes = {{name for _, names in publishers for name in names}}
    if nodes - {{"/avoidbench", "/flyer", "/watcher"}} or dict(publishers).get("/odom") != ["/avoidbench"]:
        print(f"others are here: {{publishers}}", flush=True)
        os._exit(9)
    time.sleep(0.3)
"""
# Hears all that can be published, looks at its sizes, and flies by trajectories to the goal only when all was there.
LISTENER = f"""#!{PYTHON}
import math, os
import numpy as np
import rospy
from geometry_msgs.msg import PointStamped, Pose, PoseStamped, Transform, TransformStamped, Twist, TwistStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import CameraInfo, Image, Imu, PointCloud2
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

BYTES = {{"32FC1": 4, "16UC1": 2, "mono8": 1, "rgb8": 3}}
heard = {{}}


def is_right(topic, m):
    if isinstance(m, Image):
        return m.step == m.width * BYTES[m.encoding] and len(m.data) == m.step * m.height and m.encoding in topic
    if isinstance(m, PointCloud2):
        points = np.frombuffer(m.data, "<f4").reshape(-1, 3 if topic == "/cloud" else 5)
        is_whole = len(points) == m.width and np.isfinite(points).all() and (abs(points) < 150).all()
        if topic == "/cloud":
            return is_whole
        times = points[:, 4]
        return is_whole and m.header.frame_id in topic and m.width > 500 and -0.1 <= times.min() <= times.max() <= 0.0
    if isinstance(m, CameraInfo):
        return m.width == 96 and m.K[0] > 0 and (m.P[3] < 0) == (topic == "/right_info")
    if isinstance(m, Imu):
        return abs(m.linear_acceleration.z - 9.8) < 8
    if isinstance(m, Path):
        return len(m.poses) == 1
    return True


def take(m, topic):
    if not is_right(topic, m):
        print(f"{{topic}} is wrong: {{str(m)[:200]}}", flush=True)
        os._exit(4)
    heard[topic] = m
    if topic != "/odom" or len(heard) < len(TOPICS):
        return
    p, goal = m.pose.pose.position, heard["/goal_path"].poses[0].pose.position
    away = math.dist((p.x, p.y), (goal.x, goal.y))
    command = MultiDOFJointTrajectory()
    command.header.stamp = rospy.Time.now()
    for i in range(6):
        point, part = MultiDOFJointTrajectoryPoint(time_from_start=rospy.Duration(0.3 * i)), min(1.0, 0.2 * i / max(away, 0.01))
        place, speed = Transform(), Twist()
        place.translation.x, place.translation.y = p.x + part * (goal.x - p.x), p.y + part * (goal.y - p.y)
        place.translation.z, place.rotation.w = goal.z, 1.0
        speed.linear.x, speed.linear.y = ((b - a) / max(away, 0.3) * 0.66 for a, b in ((p.x, goal.x), (p.y, goal.y)))
        point.transforms, point.velocities = [place], [speed]
        command.points.append(point)
    publisher.publish(command)


TOPICS = {{"/odom": Odometry, "/pose": PoseStamped, "/twist": TwistStamped, "/imu": Imu, "/depth_16UC1": Image, "/depth_32FC1": Image,
          "/depth_info": CameraInfo, "/cloud": PointCloud2, "/points_in_world": PointCloud2,
          "/points_of_velodyne": PointCloud2, "/camera_pose": PoseStamped, "/camera_odom": Odometry,
          "/camera_transform": TransformStamped, "/left_mono8": Image, "/right_mono8": Image, "/right_info": CameraInfo,
          "/color_rgb8": Image, "/goal_path": Path, "/goal_pose": Pose, "/goal_point": PointStamped, "/goal": PoseStamped}}
rospy.init_node("listener")
publisher = rospy.Publisher("/trajectory", MultiDOFJointTrajectory, queue_size=1)
for topic, kind in TOPICS.items():
    rospy.Subscriber(topic, kind, take, topic, buff_size=2 ** 20)
rospy.spin()
"""
ALL_TOPICS = """
nodes:
  - {name: listener, run: ./listener.py}
publish:
  odometry: {topic: /odom, velocity: body}
  pose: {topic: /pose}
  twist: {topic: /twist}
  imu: {topic: /imu}
  depth: [{topic: /depth_16UC1, encoding: 16UC1}, {topic: /depth_32FC1, info: /depth_info}]
  cloud: [{topic: /cloud, stride_px: 3}, {topic: /points_in_world, lidar: 0},
          {topic: /points_of_velodyne, lidar: 0, points_in: lidar, frame: velodyne}]
  camera_pose: [{topic: /camera_pose}, {topic: /camera_odom, type: nav_msgs/Odometry},
                {topic: /camera_transform, type: geometry_msgs/TransformStamped}]
  left: {topic: /left_mono8}
  right: {topic: /right_mono8, info: /right_info}
  color: {topic: /color_rgb8}
  goal: [{topic: /goal_path, type: nav_msgs/Path, repeat_s: 0.5}, {topic: /goal_pose, type: geometry_msgs/Pose},
         {topic: /goal_point, type: geometry_msgs/PointStamped}, {topic: /goal}]
command: {topic: /trajectory, type: trajectory_msgs/MultiDOFJointTrajectory}
live: {clock_rate: 4, start_wait_s: 30}
"""
LAUNCH = """<launch>
  <arg name="speed"/>
  <node pkg="live_test" type="flyer.py" name="flyer">
    <remap from="~odom" to="/odom"/><remap from="~depth" to="/camera/depth"/><remap from="~goal" to="/goal"/>
    <remap from="cmd_vel" to="/drone/cmd_vel"/>
    <param name="max_speed" value="$(arg speed)"/>
  </node>
</launch>
"""


def executable(file, text):
    file.write_text(text)
    file.chmod(file.stat().st_mode | stat.S_IXUSR)


class LiveRuns(Runs):
    def __init__(self, given, folder):
        super().__init__(given, folder)
        self.bridge = self.sources / "planners/ros_bridge/ros_bridge.py"
        self.example = self.sources / "planners/ros_bridge/example"
        for name in ("tmp", "home", "work"):
            (self.folder / name).mkdir()
        self.work = self.folder / "work"
        self.environment.update(TMPDIR=str(self.folder / "tmp"), HOME=str(self.folder / "home"))
        executable(self.work / "node.py", NODE)
        executable(self.work / "watcher.py", WATCHER)
        executable(self.work / "listener.py", LISTENER)
        shutil.copy(self.example / "flyer.py", self.work / "flyer.py")
        self.shared = self.shared_memory()

    def shared_memory(self):
        return {file.name for file in pathlib.Path("/dev/shm").iterdir()}

    def flies(self, name, planners, trials=1, jobs=1, sensor="depth_ideal, width_px: 160, height_px: 120"):
        """The rows (label, outcome, reason) of a run, and what it said."""
        head = HEAD.replace("TRIALS", str(trials)).replace("depth_ideal, width_px: 160, height_px: 120", sensor)
        text = head + "".join(
            f"  - {{plugin: process, label: {label}, parameters: {{command: [{self.bridge}, {topics}]}}}}\n"
            for label, topics in planners
        )
        sweep = self.work / f"{name}.yaml"
        sweep.write_text(text)
        said = self.run(sweep, f"{name}.db", "--jobs", str(jobs), "--plan-timeout", "60", code=0)
        return self.rows(name), said

    def rows(self, name):
        db = sqlite3.connect(self.folder / f"{name}.db")
        return db.execute(
            "SELECT label, outcome, reason FROM trials JOIN planners USING (planner_key) ORDER BY label"
        ).fetchall()

    def write(self, name, text):
        (self.work / name).write_text(text)
        return name

    def topics_of_example(self, **changes):
        text = (self.example / "topics.yaml").read_text().replace("clock_rate: 4", "clock_rate: 10\n  start_wait_s: 30")
        for old, new in changes.values():
            assert old in text, old
            text = text.replace(old, new)
        return text

    def expect_no_trace(self, when):
        self.expect_nothing_left(when)
        found = [str(file) for name in ("tmp", "home") for file in (self.folder / name).rglob("*") if file.is_file()]
        found += sorted(name for name in self.shared_memory() - self.shared if "ros" in name)
        found += [name for name in ("left_behind", "core") if (self.work / name).exists()]
        self.expect(f"no file is left {when}", not found, found)

    def wait_for_process(self, word, wait_s=30.0):
        """The id of a process of this test whose command has the word."""
        end = time.monotonic() + wait_s
        while time.monotonic() < end:
            for folder in pathlib.Path("/proc").iterdir():
                try:
                    if (
                        folder.name.isdigit()
                        and word in (folder / "cmdline").read_text().split("\0")
                        and f"AVOIDBENCH_TEST_MARK={self.folder}" in (folder / "environ").read_text().split("\0")
                    ):
                        return int(folder.name)
                except (OSError, UnicodeDecodeError):
                    pass
            time.sleep(0.05)
        return None


def reach(runs):
    watched = runs.topics_of_example(
        watch=("    run: ./flyer.py", "    run: ./flyer.py"),
        more=("\npublish:", "  - {name: watcher, run: ./watcher.py}\n\npublish:"),
    )
    topics = runs.write("watched.yaml", watched)
    found, _ = runs.flies("reach", [("a", topics), ("b", topics)], trials=2, jobs=2)
    runs.expect(
        "four flights with two workers reach their goals", [row[1] for row in found] == ["reached_goal"] * 4, found
    )
    runs.expect_no_trace("after them")
    sandbox = sqlite3.connect(runs.folder / "reach.db").execute("SELECT sandbox FROM runs").fetchall()[0][0]
    runs.expect("in the sandbox, with network", "network" in sandbox or "none" in sandbox, sandbox)
    verified = subprocess.run(
        [runs.program, "replay", runs.folder / "reach.db", "--verify", "--sweep-file", runs.work / "reach.yaml"],
        cwd=runs.work,
        env=runs.environment,
        capture_output=True,
        text=True,
    )
    said = verified.stdout + verified.stderr
    runs.expect("replay --verify says what it finds", verified.returncode in (0, 1) and "flown again" in said, said)


def heard(runs):
    found, _ = runs.flies(
        "heard",
        [("all", runs.write("all_topics.yaml", ALL_TOPICS))],
        sensor="stereo_sgm, width_px: 96, height_px: 72, lidars: [{preset: velodyne_16, columns: 360}]",
    )
    runs.expect("all that can be published is heard, and a trajectory flown", have_flown(found, 1), found)
    runs.expect_no_trace("after it")


def outcomes(runs):
    ways = {
        "exits": ("planner_crashed", "the node node ended with exit code 3"),
        "segfault": ("planner_crashed", "ended by signal 11"),
        "writes": ("planner_crashed", "run --no-sandbox lets them"),
        "silent": ("timed_out", ""),
        "unsaid": ("planner_error", "nobody publishes /cmd_velo (geometry_msgs/TwistStamped); there is /cmd_vel"),
        "unheard": ("planner_error", "nobody subscribes to /imu"),
        "blind": ("planner_error", "blind_topics.yaml:8:18: /points is of a lidar, and the sensor has none"),
        "stranger": ("planner_error", "there is no Python class of own_msgs/Twist"),
    }
    changes = {
        "unsaid": ("/cmd_vel", "/cmd_velo"),
        "unheard": ("  goal:", "  imu: {topic: /imu}\n  goal:"),
        "blind": ("  goal:", "  depth: {topic: /depth}\n  cloud: {topic: /points, lidar: 0}\n  goal:"),
        "stranger": ("geometry_msgs/TwistStamped", "own_msgs/Twist"),
    }
    planners = []
    for way in ways:
        text = TOPICS.replace("WAY", way).replace(*changes.get(way, ("start_wait_s", "answer_wait_s: 0, start_wait_s")))
        planners.append((way, runs.write(f"{way}_topics.yaml", text)))
    found, _ = runs.flies("outcomes", planners, jobs=2)
    for label, (outcome, reason) in ways.items():
        rows = [row for row in found if row[0] == label]
        runs.expect(f"{label}: {outcome}", len(rows) == 1 and rows[0][1] == outcome and reason in rows[0][2], rows)
    said = [row[2] for row in found if row[0] == "exits"]
    runs.expect("with its last words", "last words" in "".join(said), said)
    runs.expect_no_trace("after nodes that end")


def killed(runs):
    topics = runs.write("killed_topics.yaml", TOPICS.replace("WAY", "flies"))
    sweep = (
        HEAD.replace("TRIALS", "2")
        + f"  - {{plugin: process, label: a, parameters: {{command: [{runs.bridge}, {topics}]}}}}\n"
    )
    (runs.work / "killed.yaml").write_text(sweep)
    for whom, word in (("the node", "./node.py"), ("the worker", "worker"), ("the run", "run")):
        process = runs.start(
            runs.work / "killed.yaml", f"killed_{word.strip('./')}.db", "--jobs", "1", "--plan-timeout", "60"
        )
        node = runs.wait_for_process("./node.py")
        time.sleep(1.5)
        victim = process.pid if word == "run" else node if word == "./node.py" else runs.wait_for_process(word)
        os.kill(victim, signal.SIGKILL)
        process.communicate()
        if word == "./node.py":
            found = runs.rows("killed_node.py")
            crashed = [
                row for row in found if row[1] == "planner_crashed" and "the node node ended by signal 9" in row[2]
            ]
            runs.expect("a node that is killed costs its trial alone", len(found) == 2 and len(crashed) == 1, found)
        runs.expect_no_trace(f"after SIGKILL of {whom}")


def launched(runs):
    package = runs.work / "live_test"
    package.mkdir()
    (package / "package.xml").write_text("<package><name>live_test</name></package>\n")
    shutil.copy(runs.work / "flyer.py", package / "flyer.py")
    (package / "flight.launch").write_text(LAUNCH)
    runs.environment["ROS_PACKAGE_PATH"] = f"{runs.work}:/usr/share"
    begin, end = "    run: ./flyer.py", "\n\npublish:"
    text = runs.topics_of_example(launch=("live:\n", "live:\n  launch: [live_test, flight.launch, 'speed:=0.8']\n"))
    text = "\n".join(
        line
        for line in text.split("\n")
        if begin not in line and "remap:" not in line and "      max_speed:" not in line
    )
    found, _ = runs.flies("launched", [("launched", runs.write("launched_topics.yaml", text))])
    runs.expect("a launch file's node reaches the goal", [row[1] for row in found] == ["reached_goal"], found)
    bad = text.replace("'speed:=0.8'", "'sped:=0.8'")
    found, _ = runs.flies("launched_badly", [("launched", runs.write("bad_topics.yaml", bad))])
    runs.expect(
        "a mistake in it has its place", found[0][1] == "planner_error" and "bad_topics.yaml:" in found[0][2], found
    )
    assert end in text
    runs.expect_no_trace("after launch files")


def have_flown(found, count):
    return len(found) == count and all(row[1] in ("reached_goal", "collided") for row in found)


def running(runs):
    """Nodes of somebody else, beside a roscore, and nodes that live on from trial to trial."""
    log = runs.folder / "ros_log"
    log.mkdir()
    uri = "http://127.0.0.1:11417"
    own = {**os.environ, "ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1", "ROS_LOG_DIR": str(log), "ROS_HOME": str(log)}
    started = [
        subprocess.Popen(["roscore", "-p", "11417"], env=own, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    ]
    try:
        for _ in range(100):
            if (
                subprocess.run(["rosparam", "set", "/use_sim_time", "true"], env=own, capture_output=True).returncode
                == 0
            ):
                break
            time.sleep(0.1)
        started.append(subprocess.Popen(["./node.py", "straight"], cwd=runs.work, env=own))
        runs.environment.update(ROS_MASTER_URI=uri, ROS_IP="127.0.0.1")
        text = (
            TOPICS.replace(", run: [./node.py, WAY]", "")
            .replace("WAY", "runs")
            .replace("live: {", "live: {master: running, ")
        )
        found, _ = runs.flies("running", [("runs", runs.write("running_topics.yaml", text))], trials=2)
        runs.expect("nodes that run already fly two trials", have_flown(found, 2), found)
        runs.expect("and live on", started[1].poll() is None)
    finally:
        for process in reversed(started):
            process.send_signal(signal.SIGINT)
            process.wait()
    found, _ = runs.flies("gone", [("runs", "running_topics.yaml")])
    runs.expect("a master that is gone", "no master answers at" in found[0][2], found)
    never = TOPICS.replace("WAY", "never").replace("live: {", "live: {restart: never, ")
    found, _ = runs.flies("never", [("never", runs.write("never_topics.yaml", never))], trials=2)
    runs.expect("nodes that are never started again fly two trials", have_flown(found, 2), found)
    measured = HEAD.replace("{mode: fixed, ms: 33}", "{mode: measured}").replace("TRIALS", "1")
    measured += f"  - {{plugin: process, parameters: {{command: [{runs.bridge}, never_topics.yaml]}}}}\n"
    (runs.work / "measured.yaml").write_text(measured)
    runs.run(runs.work / "measured.yaml", "measured.db", "--jobs", "1", "--plan-timeout", "60")
    found = runs.rows("measured")
    runs.expect("measured latency with pauses is refused", "would count the pauses" in found[0][2], found)
    runs.expect_no_trace("after masters that run")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("sources")
    parser.add_argument("--only", default="")
    given = parser.parse_args()
    given.program = str(pathlib.Path(given.program).absolute())
    given.programs = given.torture = "."
    has_ros = (
        subprocess.run(
            [PYTHON, "-c", "import rospy, rosmaster, roslaunch, yaml, numpy"], capture_output=True
        ).returncode
        == 0
    )
    if not has_ros or shutil.which("roscore") is None:
        print(f"passed over: {PYTHON} has no rospy, or there is no roscore: scripts/install_packages.sh ros_live")
        sys.exit(77)
    folder = tempfile.mkdtemp()
    try:
        runs = LiveRuns(given, folder)
        for part in (reach, heard, outcomes, killed, launched, running):
            if given.only in ("", part.__name__):
                part(runs)
    finally:
        shutil.rmtree(folder)
    sys.exit(1 if runs.problems else 0)


if __name__ == "__main__":
    main()
