#!/usr/bin/python3
"""A ROS 1 node as one writes it for a vehicle: odometry, depth image and goal in, velocity out. It knows nothing of
avoidbench."""

import math

import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image

FREE_M = 4.0  # so far is far enough
STEPS = 31


class Flyer:
    def __init__(self):
        self.max_speed = rospy.get_param("~max_speed")
        self.fx, self.cx = rospy.get_param("~camera/fx"), rospy.get_param("~camera/cx")
        self.margin = rospy.get_param("~margin")
        self.odometry, self.goal, self.rays = None, None, None
        self.publisher = rospy.Publisher("cmd_vel", TwistStamped, queue_size=1)
        rospy.Subscriber("~goal", PoseStamped, self.take_goal)
        rospy.Subscriber("~depth", Image, self.take_depth, queue_size=1, buff_size=2**22)
        rospy.Subscriber("~odom", Odometry, self.take_odometry, queue_size=1, tcp_nodelay=True)
        rospy.loginfo("ready")

    def take_goal(self, message):
        self.goal = message.pose.position

    def take_depth(self, message):
        """The nearest depth of each column, in the rows at flight height."""
        depth = np.frombuffer(message.data, "<f4").reshape(message.height, message.width)
        rows = depth[3 * message.height // 8 : 5 * message.height // 8]
        nearest = np.where(np.isnan(rows), 0.0, np.minimum(rows, 20.0)).min(axis=0)
        self.rays = (np.arctan2(self.cx - np.arange(message.width), self.fx), nearest)

    def free_m(self, bearing):
        """How far the body gets along a bearing that the camera sees."""
        angles, depth = self.rays
        along, aside = (
            depth * np.cos(angles - bearing) / np.cos(angles),
            depth * np.sin(angles - bearing) / np.cos(angles),
        )
        hit = along[(np.abs(aside) < self.margin) & (along > 0.0)]
        return hit.min() if hit.size else 20.0

    def take_odometry(self, message):
        if self.goal is None:
            return
        p, q = message.pose.pose.position, message.pose.pose.orientation
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        away = math.hypot(self.goal.x - p.x, self.goal.y - p.y)
        to_goal = math.remainder(math.atan2(self.goal.y - p.y, self.goal.x - p.x) - yaw, math.tau)
        command = TwistStamped()
        command.header.stamp = message.header.stamp
        bearing, speed = to_goal, 0.0
        if self.rays is not None:
            seen = min(abs(self.rays[0][0]), abs(self.rays[0][-1]))
            ways = [
                (abs(one - to_goal) - 0.8 * min(self.free_m(one), FREE_M, away), one)
                for one in np.linspace(-seen, seen, STEPS)
            ]
            bearing = min(ways)[1]
            speed = min(self.max_speed, 0.5 * max(0.0, self.free_m(bearing) - 0.5), 0.5 * away + 0.2)
            speed *= max(0.0, math.cos(bearing)) if abs(to_goal) < 1.6 else 0.0
        command.twist.linear.x = speed * math.cos(yaw + bearing)
        command.twist.linear.y = speed * math.sin(yaw + bearing)
        command.twist.linear.z = max(-0.5, min(0.5, self.goal.z - p.z))
        command.twist.angular.z = max(-1.0, min(1.0, 2.0 * (bearing if abs(to_goal) < 1.6 else to_goal)))
        self.publisher.publish(command)


rospy.init_node("flyer")
Flyer()
rospy.spin()
