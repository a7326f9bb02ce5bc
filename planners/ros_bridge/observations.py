"""What a planner sees, as messages on the topics that `publish` names: the same as
planners/ros_shim/src/observations.cpp."""

import functools
import math

import numpy as np
import rospy
from avoidbench.planner import State
from genpy import Time
from geometry_msgs.msg import PointStamped, Pose, PoseStamped, TransformStamped, TwistStamped
from nav_msgs.msg import Odometry, Path
from ros_processes import StartProblem
from sensor_msgs.msg import CameraInfo, Image, Imu, PointCloud2, PointField
from std_msgs.msg import Header

QUEUE = 10
POSES = {
    "geometry_msgs/PoseStamped": PoseStamped,
    "nav_msgs/Odometry": Odometry,
    "geometry_msgs/TransformStamped": TransformStamped,
}
GOALS = {
    "geometry_msgs/PoseStamped": PoseStamped,
    "geometry_msgs/PointStamped": PointStamped,
    "nav_msgs/Path": Path,
    "geometry_msgs/Pose": Pose,
}
TYPES = {
    "odometry": Odometry,
    "pose": PoseStamped,
    "twist": TwistStamped,
    "imu": Imu,
    "depth": Image,
    "cloud": PointCloud2,
    "left": Image,
    "right": Image,
    "color": Image,
}


def time_of(time_ns):
    return Time(time_ns // 10**9, time_ns % 10**9)


def put(vector, numbers):
    vector.x, vector.y, vector.z = (float(number) for number in numbers)


def pose_of(position_m, q_wxyz):
    pose = Pose()
    put(pose.position, position_m)
    o = pose.orientation
    o.w, o.x, o.y, o.z = (float(number) for number in q_wxyz)
    return pose


def rotation_of(q):
    """The matrix of a quaternion (w, x, y, z)."""
    w, x, y, z = (float(number) for number in q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def camera_info(header, camera, baseline_m):
    info = CameraInfo(
        header=header, width=camera.width_px, height=camera.height_px, distortion_model="plumb_bob", D=[0.0] * 5
    )
    fx, fy, cx, cy = camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px
    info.K = [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]
    info.R = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    # Of a right eye; a left one has 0.
    info.P = [fx, 0.0, cx, -fx * baseline_m, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]
    return info


def depth_message(header, depth_m, one):
    depth = np.where(np.isnan(depth_m), np.float32(one["invalid_m"]), depth_m)
    depth = np.where(np.isinf(depth), np.float32(one["no_return_m"]), depth).astype("<f4")
    message = Image(
        header=header, height=depth.shape[0], width=depth.shape[1], encoding="16UC1" if one["in_mm"] else "32FC1"
    )
    if one["in_mm"]:
        with np.errstate(invalid="ignore"):
            mm = np.floor(depth * np.float32(1000.0) + np.float32(0.5))
            # Beyond 65.5 m there is no number: as no return.
            depth = np.where((mm > 0.0) & (mm <= 65535.0), mm, 0.0).astype("<u2")
    message.step = depth.itemsize * depth.shape[1]
    message.data = depth.tobytes()
    return message


def require_sensors(published, setup):
    """Raises StartProblem, with the place in the topics file, where a topic is of a lidar or a camera that the sensor
    lacks. A sensor of which the nodes see nothing is refused before; one that has either cameras or lidars is not,
    where a file publishes of both, and nodes would wait in silence."""
    for one in published:
        if one["sees"] in ("depth", "stereo", "color") and not setup.cameras:
            raise StartProblem(str(one["place"].problem(f"{one['topic']} is of a camera, and the sensor has none")))
        if one["sees"] != "points" or one["lidar"] < len(setup.lidars):
            continue
        if not setup.lidars:
            raise StartProblem(str(one["place"].problem(f"{one['topic']} is of a lidar, and the sensor has none")))
        text = f"there is no lidar {one['lidar']}: the sensor has {len(setup.lidars)}, counted from 0"
        raise StartProblem(str(one["place"].problem(f"{one['topic']}: {text}")))


def point_cloud(header, names, numbers):
    """A PointCloud2 of float32 fields that follow one another; `numbers` (N, as many as names)."""
    size = 4 * len(names)
    fields = [PointField(name=name, offset=4 * i, datatype=PointField.FLOAT32, count=1) for i, name in enumerate(names)]
    return PointCloud2(
        header=header,
        height=1,
        width=len(numbers),
        fields=fields,
        point_step=size,
        row_step=size * len(numbers),
        data=np.ascontiguousarray(numbers, "<f4").tobytes(),
        is_dense=True,
    )


def sweep_message(header, sweep, lidar, points_in):
    """The points of `sweep`, an avoidbench.planner.Cloud, in metres in the coordinates of the world, the body or the
    lidar, each with its intensity and its time after the sweep's end: seconds, at most 0. `lidar`: an
    avoidbench.planner.Lidar."""
    points = sweep.points_lidar_m
    if points_in == "world":
        points = points.astype(np.float64) @ rotation_of(sweep.q_world_lidar).T + sweep.position_world_m
    elif points_in == "body":
        points = points.astype(np.float64) @ rotation_of(lidar.q_body_lidar).T + lidar.position_body_m
    numbers = np.column_stack([points.astype("<f4"), sweep.intensities, sweep.point_times_s])
    return point_cloud(header, ["x", "y", "z", "intensity", "time"], numbers)


def cloud_message(header, image, camera, stride_px):
    depth = image.depth_m[::stride_px, ::stride_px].astype(np.float64)
    rows, columns = np.mgrid[0 : image.depth_m.shape[0] : stride_px, 0 : image.depth_m.shape[1] : stride_px]
    is_seen = np.isfinite(depth) & (depth > 0.0)
    z = depth[is_seen]
    x, y = (columns[is_seen] - camera.cx_px) / camera.fx_px * z, (rows[is_seen] - camera.cy_px) / camera.fy_px * z
    in_camera = np.stack([x, y, z], axis=1)
    points = (in_camera @ rotation_of(image.q_world_camera).T + image.position_world_m).astype("<f4")
    return point_cloud(header, "xyz", points)


def _type_of(one):
    if one["kind"] == "camera_pose":
        return POSES[one["type"]]
    return GOALS[one["type"]] if one["kind"] == "goal" else TYPES[one["kind"]]


class Observations:
    """The publishers of a flight. `setup`: an avoidbench.planner.Setup. Raises as require_sensors()."""

    def __init__(self, published, setup):
        require_sensors(published, setup)
        self._cameras, self._lidars = setup.cameras, setup.lidars
        self._topics = []
        for one in published:
            publisher = rospy.Publisher(
                one["topic"], _type_of(one), queue_size=QUEUE, tcp_nodelay=True, latch=one["kind"] == "goal"
            )
            info = rospy.Publisher(one["info"], CameraInfo, queue_size=QUEUE, tcp_nodelay=True) if one["info"] else None
            self._topics.append((one, publisher, info))
        self._goal_due_ns = {}

    def begin(self, base_ns, mission):
        """A trial whose time 0 is ROS time base_ns."""
        self._base_ns, self._mission, self._goal_due_ns = base_ns, mission, {}
        self._goal_world_m = tuple(mission.goal_world_m)

    def connections(self, topic):
        return sum(publisher.get_num_connections() for one, publisher, _ in self._topics if one["topic"] == topic)

    def ns_of(self, time_s):
        return self._base_ns + round(1e9 * float(time_s))

    def _header(self, time_s, one):
        return Header(stamp=time_of(self.ns_of(time_s)), frame_id=one["frame"])

    def _of(self, *kinds):
        return [topic for topic in self._topics if topic[0]["kind"] in kinds]

    def samples(self, seen):
        """Of a call: samples of the IMU and states since the last one, as (ROS time, what publishes it), oldest
        first."""
        found = [
            (self.ns_of(seen.imu.time_s[i]), functools.partial(self._publish_imu, seen.imu, i))
            for i in range(len(seen.imu.time_s) if seen.imu is not None else 0)
        ]
        found += [
            (self.ns_of(state.time_s), functools.partial(self._publish_state, state, True)) for state in seen.states
        ]
        return sorted(found, key=lambda sample: sample[0])

    def _publish_imu(self, samples, i):
        for one, publisher, _ in self._of("imu"):
            message = Imu(header=self._header(samples.time_s[i], one))
            message.orientation_covariance[0] = -1.0  # ROS's sign for: no orientation
            put(message.angular_velocity, samples.rates_body_radps[i])
            put(message.linear_acceleration, samples.specific_force_body_mps2[i])
            publisher.publish(message)

    def _publish_state(self, state, all_states):
        """On the topics of all states, or on those of the newest of a call."""
        time_s, position_m, q = state.time_s, state.position_world_m, state.q_world_body
        for one, publisher, _ in self._of("odometry", "pose", "twist"):
            if one["all_states"] != all_states:
                continue
            header = self._header(time_s, one)
            if one["kind"] == "odometry":
                message = Odometry(header=header, child_frame_id=one["child_frame"])
                message.pose.pose = pose_of(position_m, q)
                put(
                    message.twist.twist.linear,
                    rotation_of(q).T @ state.velocity_world_mps if one["in_body"] else state.velocity_world_mps,
                )
                put(message.twist.twist.angular, state.rates_body_radps)
            elif one["kind"] == "pose":
                message = PoseStamped(header=header, pose=pose_of(position_m, q))
            else:
                message = TwistStamped(header=header)
                put(message.twist.linear, state.velocity_world_mps)
                put(message.twist.angular, state.rates_body_radps)
            publisher.publish(message)

    def publish_start(self, time_s):
        """The vehicle hovers before the trial."""
        half = 0.5 * self._mission.start_yaw_rad
        state = State(
            time_s,
            self._mission.start_world_m,
            np.zeros(3),
            np.array([math.cos(half), 0.0, 0.0, math.sin(half)]),
            np.zeros(3),
        )
        for all_states in (False, True):
            self._publish_state(state, all_states)

    def _publish_depth(self, image):
        camera = self._cameras[image.camera]
        for one, publisher, _ in self._of("camera_pose"):
            if one["camera"] != image.camera:
                continue
            header, pose = self._header(image.time_s, one), pose_of(image.position_world_m, image.q_world_camera)
            message = POSES[one["type"]](header=header)
            if one["type"] == "nav_msgs/Odometry":
                message.pose.pose = pose
            elif one["type"] == "geometry_msgs/PoseStamped":
                message.pose = pose
            else:
                put(message.transform.translation, image.position_world_m)
                message.transform.rotation = pose.orientation
            publisher.publish(message)
        for one, publisher, info in self._of("depth"):
            if one["camera"] == image.camera:
                header = self._header(image.time_s, one)
                if info is not None:
                    info.publish(camera_info(header, camera, 0.0))
                publisher.publish(depth_message(header, image.depth_m, one))
        for one, publisher, _ in self._of("cloud"):
            if one["lidar"] is None and one["camera"] == image.camera:
                publisher.publish(cloud_message(self._header(image.time_s, one), image, camera, one["stride_px"]))

    def _publish_sweep(self, sweep):
        for one, publisher, _ in self._of("cloud"):
            if one["lidar"] == sweep.lidar:
                header = self._header(sweep.time_s, one)
                publisher.publish(sweep_message(header, sweep, self._lidars[sweep.lidar], one["points_in"]))

    def _publish_picture(self, picture, kind):
        for one, publisher, info in self._of(kind):
            if one["camera"] != picture.camera:
                continue
            camera, header = self._cameras[picture.camera], self._header(picture.time_s, one)
            pixels = np.ascontiguousarray(picture.pixels)
            if info is not None:
                info.publish(camera_info(header, camera, camera.baseline_m if kind == "right" else 0.0))
            publisher.publish(
                Image(
                    header=header,
                    height=pixels.shape[0],
                    width=pixels.shape[1],
                    encoding="rgb8" if pixels.ndim == 3 else "mono8",
                    step=pixels[0].nbytes,
                    data=pixels.tobytes(),
                )
            )

    def _publish_goals(self, now_ns):
        for one, publisher, _ in self._of("goal"):
            if now_ns < self._goal_due_ns.get(one["topic"], 0):
                continue
            self._goal_due_ns[one["topic"]] = (
                now_ns + round(1e9 * one["repeat_s"]) if one["repeat_s"] > 0.0 else math.inf
            )
            stamped = PoseStamped(
                header=Header(stamp=time_of(now_ns), frame_id=one["frame"]),
                pose=pose_of(self._goal_world_m, (1.0, 0.0, 0.0, 0.0)),
            )
            messages = {
                "geometry_msgs/PoseStamped": stamped,
                "geometry_msgs/Pose": stamped.pose,
                "geometry_msgs/PointStamped": PointStamped(header=stamped.header, point=stamped.pose.position),
                "nav_msgs/Path": Path(header=stamped.header, poses=[stamped]),
            }
            publisher.publish(messages[one["type"]])

    def publish(self, seen, now_ns):
        self._publish_state(seen, False)
        # Oldest first, as they were taken.
        for image in reversed(seen.depth):
            self._publish_depth(image)
        for pair in reversed(seen.stereo):
            self._publish_picture(pair.left, "left")
            self._publish_picture(pair.right, "right")
        for picture in reversed(seen.color):
            self._publish_picture(picture, "color")
        for sweep in reversed(seen.clouds):
            self._publish_sweep(sweep)
        # Another goal, or one that has moved, is sent at once.
        if seen.goal_world_m is not None and tuple(seen.goal_world_m) != self._goal_world_m:
            self._goal_world_m, self._goal_due_ns = tuple(seen.goal_world_m), {}
        self._publish_goals(now_ns)
