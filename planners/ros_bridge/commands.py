"""What the usual command messages say, as commands of avoidbench: the same as set_point.h and commands.cpp of
planners/ros_shim."""

import math
from dataclasses import dataclass, field

import numpy as np
from avoidbench.planner import Acceleration, Position, Rates, Trajectory, Velocity


@dataclass
class SetPoint:
    """Where to be when; None is what is not said."""

    time_ns: int  # ROS time at which it holds
    position_m: object = None
    velocity_mps: object = None
    acceleration_mps2: object = None
    yaw_rad: object = None
    yaw_rate_radps: object = None
    rates_body_radps: object = None
    thrust: float = 0.0
    in_heading_frame: bool = field(default=False)

    def after(self, after_s):
        """The motion `after_s` later at a constant acceleration: position, velocity, acceleration, yaw, yaw rate."""
        v = self.velocity_mps if self.velocity_mps is not None else np.zeros(3)
        a = self.acceleration_mps2 if self.acceleration_mps2 is not None else np.zeros(3)
        rate = self.yaw_rate_radps or 0.0
        return (
            self.position_m + (v + 0.5 * a * after_s) * after_s,
            v + a * after_s,
            a,
            (self.yaw_rad or 0.0) + rate * after_s,
            rate,
        )


def xyz(vector):
    return np.array([vector.x, vector.y, vector.z], np.float64)


def yaw_of(x, y, z, w):
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def of_position_command(message, now_ns):
    return [
        SetPoint(
            now_ns,
            xyz(message.position),
            xyz(message.velocity),
            xyz(message.acceleration),
            message.yaw,
            message.yaw_dot,
        )
    ]


def of_twist(message, now_ns):
    return [SetPoint(now_ns, velocity_mps=xyz(message.linear), yaw_rate_radps=message.angular.z)]


def of_pose_stamped(message, now_ns):
    q = message.pose.orientation
    return [SetPoint(now_ns, xyz(message.pose.position), yaw_rad=yaw_of(q.x, q.y, q.z, q.w))]


def of_position_target(message, now_ns):
    """Its type_mask says what does not count. Frame 8 (BODY_NED) is the body's heading, as mavros turns it: x forward,
    y left, z up."""
    mask = message.type_mask
    if mask & 512:
        raise ValueError("a PositionTarget with a force, not acceleration")
    point = SetPoint(now_ns, in_heading_frame=message.coordinate_frame == 8)
    point.position_m = None if mask & 7 else xyz(message.position)
    point.velocity_mps = None if mask & 56 else xyz(message.velocity)
    point.acceleration_mps2 = None if mask & 448 else xyz(message.acceleration_or_force)
    point.yaw_rad = None if mask & 1024 else message.yaw
    point.yaw_rate_radps = None if mask & 2048 else message.yaw_rate
    if point.in_heading_frame and (point.position_m is not None or point.acceleration_mps2 is not None):
        raise ValueError("a PositionTarget in the body's frame with more than a velocity")
    return [point]


def of_attitude_target(message, now_ns):
    """Body rates and thrust; an attitude is not followed here."""
    if message.type_mask & (1 | 2 | 4 | 64):
        raise ValueError("an AttitudeTarget without all body rates and thrust")
    return [SetPoint(now_ns, rates_body_radps=xyz(message.body_rate), thrust=message.thrust)]


def of_trajectory(message, now_ns):
    """The first joint."""
    begin_ns = message.header.stamp.to_nsec() or now_ns
    points = []
    for one in message.points:
        if not one.transforms:
            raise ValueError("a trajectory's point has no transform")
        q = one.transforms[0].rotation
        point = SetPoint(
            begin_ns + one.time_from_start.to_nsec(),
            xyz(one.transforms[0].translation),
            yaw_rad=yaw_of(q.x, q.y, q.z, q.w),
        )
        if one.velocities:
            point.velocity_mps, point.yaw_rate_radps = xyz(one.velocities[0].linear), one.velocities[0].angular.z
        if one.accelerations:
            point.acceleration_mps2 = xyz(one.accelerations[0].linear)
        points.append(point)
    return points


READERS = {
    "PositionCommand": of_position_command,
    "Twist": of_twist,
    "TwistStamped": lambda message, now_ns: of_twist(message.twist, now_ns),
    "PoseStamped": of_pose_stamped,
    "PositionTarget": of_position_target,
    "AttitudeTarget": of_attitude_target,
    "MultiDOFJointTrajectory": of_trajectory,
}


def trajectory_of(points):
    """Of (time after now, motion); yaws go on from one to the next without a turn of 360°."""
    yaws = [points[0][1][3]]
    for _, motion in points[1:]:
        yaws.append(yaws[-1] + math.remainder(motion[3] - yaws[-1], math.tau))
    columns = [np.array([motion[i] for _, motion in points]) for i in range(3)]
    return Trajectory(
        [time_s for time_s, _ in points], *columns, yaw_rad=yaws, yaw_rate_radps=[motion[4] for _, motion in points]
    )


class Commands:
    """The newest command of the nodes, and what it is at a time."""

    def __init__(self, spec, plan_period_s, gravity_mps2):
        self._spec, self._plan_period_s, self._gravity_mps2 = spec, plan_period_s, gravity_mps2
        self._read = READERS[spec.form]
        self._last = []

    def forget(self):
        self._last = []

    def take(self, message, now_ns):
        points = self._read(message, now_ns)
        for point in points:
            point.in_heading_frame = point.in_heading_frame or self._spec.in_body
        self._last = points or self._last

    def answer(self, now_ns, q_world_body):
        """None before the first one and when the last is too old."""
        points = self._last
        if not points or 1e-9 * (now_ns - points[-1].time_ns) > self._spec.stale_s:
            return None
        return self._of_one(points[0], now_ns, q_world_body) if len(points) == 1 else self._of_many(points, now_ns)

    def _of_one(self, point, now_ns, q):
        if point.rates_body_radps is not None:
            return Rates(point.rates_body_radps, point.thrust / self._spec.hover_thrust * self._gravity_mps2)
        if point.position_m is not None and point.velocity_mps is not None:
            age_s, ahead_s = max(0.0, 1e-9 * (now_ns - point.time_ns)), 2.0 * self._plan_period_s
            # Two plan periods of it: the next answer comes after one.
            return trajectory_of([(0.0, point.after(age_s)), (ahead_s, point.after(age_s + ahead_s))])
        yaw_rad = yaw_of(q[1], q[2], q[3], q[0])
        if point.position_m is not None:
            return Position(point.position_m, yaw_rad=yaw_rad if point.yaw_rad is None else point.yaw_rad)
        turn = {"yaw_rate_radps": point.yaw_rate_radps or 0.0} if point.yaw_rad is None else {"yaw_rad": point.yaw_rad}
        if point.velocity_mps is not None:
            x, y, z = point.velocity_mps
            if point.in_heading_frame:
                c, s = math.cos(yaw_rad), math.sin(yaw_rad)
                x, y = c * x - s * y, s * x + c * y
            return Velocity([x, y, z], **turn)
        if point.acceleration_mps2 is not None:
            return Acceleration(point.acceleration_mps2, **turn)
        raise ValueError("a command that says neither where nor how fast")

    def _of_many(self, points, now_ns):
        step_s = 0.05
        found = []
        for i, point in enumerate(points):
            after_s = 1e-9 * (point.time_ns - now_ns)
            is_last = i + 1 == len(points)
            if after_s <= 0.0:
                if is_last or points[i + 1].time_ns > now_ns:  # the one that holds now, brought to now
                    found.append((0.0, point.after(-after_s)))
                continue
            if not found:  # a trajectory that begins later: its beginning holds until then
                found.append((0.0, point.after(0.0)))
            if is_last or after_s >= found[-1][0] + step_s - 1e-9:
                found.append((after_s, point.after(0.0)))
        if len(found) < 2:
            position, _, _, yaw, rate = found[0][1]
            found.append((2.0 * self._plan_period_s, (position, np.zeros(3), np.zeros(3), yaw, rate)))
        return trajectory_of(found)
