#ifndef ROS_SHIM_SET_POINT_H
#define ROS_SHIM_SET_POINT_H

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

// What the usual command messages say, for the planner's answer. The generated source of a planner
// includes this with its message's header; C++17.
namespace ros_shim {

/// Where to be when; what is not said is not set.
struct SetPoint {
  std::int64_t time_ns = 0;  ///< ROS time at which it holds
  bool has_position = false, has_velocity = false, has_acceleration = false, has_jerk = false;
  bool has_yaw = false, has_yaw_rate = false, has_rates = false;
  /// The velocity is along the body's heading, not the world's axes.
  bool in_heading_frame = false;
  std::array<double, 3> position_m{}, velocity_mps{}, acceleration_mps2{}, jerk_mps3{};
  std::array<double, 3> rates_body_radps{};
  double yaw_rad = 0.0, yaw_rate_radps = 0.0;
  double thrust = 0.0;  ///< as the message has it; see CommandForm::hover_thrust
};

/// One set point, or several of a trajectory in the order of time.
using SetPoints = std::vector<SetPoint>;

double yaw_of_quaternion(double x, double y, double z, double w);

template <class V>
std::array<double, 3> xyz(const V& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
template <class M>
std::int64_t stamp_ns(const M& message, std::int64_t now_ns) {
  const std::int64_t stamp = message.header.stamp.toNSec();
  return stamp > 0 ? stamp : now_ns;
}

/// quadrotor_msgs/PositionCommand and whatever has its members.
template <class M>
SetPoints points_of_position_command(const M& message, std::int64_t now_ns) {
  SetPoint point;
  point.time_ns = now_ns;
  point.has_position = point.has_velocity = point.has_acceleration = true;
  point.has_yaw = point.has_yaw_rate = true;
  point.position_m = xyz(message.position);
  point.velocity_mps = xyz(message.velocity);
  point.acceleration_mps2 = xyz(message.acceleration);
  point.yaw_rad = message.yaw;
  point.yaw_rate_radps = message.yaw_dot;
  return {point};
}

/// geometry_msgs/Twist: velocity and yaw rate.
template <class M>
SetPoints points_of_twist(const M& message, std::int64_t now_ns) {
  SetPoint point;
  point.time_ns = now_ns;
  point.has_velocity = point.has_yaw_rate = true;
  point.velocity_mps = xyz(message.linear);
  point.yaw_rate_radps = message.angular.z;
  return {point};
}
template <class M>
SetPoints points_of_twist_stamped(const M& message, std::int64_t now_ns) {
  return points_of_twist(message.twist, now_ns);
}

/// geometry_msgs/PoseStamped: position and yaw.
template <class M>
SetPoints points_of_pose_stamped(const M& message, std::int64_t now_ns) {
  SetPoint point;
  point.time_ns = now_ns;
  point.has_position = point.has_yaw = true;
  point.position_m = xyz(message.pose.position);
  const auto& q = message.pose.orientation;
  point.yaw_rad = yaw_of_quaternion(q.x, q.y, q.z, q.w);
  return {point};
}

/// mavros_msgs/PositionTarget: its type_mask says what does not count. Frame 8 (BODY_NED) is the
/// body's heading, as mavros turns it: x forward, y left, z up.
template <class M>
SetPoints points_of_position_target(const M& message, std::int64_t now_ns) {
  const unsigned mask = message.type_mask;
  if ((mask & 512U) != 0)
    throw std::runtime_error("a PositionTarget with a force, not acceleration");
  const auto all_of = [mask](unsigned bits) { return (mask & bits) == 0; };
  SetPoint point;
  point.time_ns = now_ns;
  point.in_heading_frame = message.coordinate_frame == 8;
  point.has_position = all_of(7U);
  point.has_velocity = all_of(56U);
  point.has_acceleration = all_of(448U);
  point.has_yaw = all_of(1024U);
  point.has_yaw_rate = all_of(2048U);
  if (point.in_heading_frame && (point.has_position || point.has_acceleration)) {
    throw std::runtime_error("a PositionTarget in the body's frame with more than a velocity");
  }
  point.position_m = xyz(message.position);
  point.velocity_mps = xyz(message.velocity);
  point.acceleration_mps2 = xyz(message.acceleration_or_force);
  point.yaw_rad = message.yaw;
  point.yaw_rate_radps = message.yaw_rate;
  return {point};
}

/// mavros_msgs/AttitudeTarget: body rates and thrust; an attitude is not followed here.
template <class M>
SetPoints points_of_attitude_target(const M& message, std::int64_t now_ns) {
  if ((message.type_mask & (1U | 2U | 4U | 64U)) != 0) {
    throw std::runtime_error("an AttitudeTarget without all body rates and thrust");
  }
  SetPoint point;
  point.time_ns = now_ns;
  point.has_rates = true;
  point.rates_body_radps = xyz(message.body_rate);
  point.thrust = message.thrust;
  return {point};
}

/// trajectory_msgs/MultiDOFJointTrajectory: the first joint.
template <class M>
SetPoints points_of_trajectory(const M& message, std::int64_t now_ns) {
  const std::int64_t begin_ns = stamp_ns(message, now_ns);
  SetPoints points;
  for (const auto& one : message.points) {
    if (one.transforms.empty()) throw std::runtime_error("a trajectory's point has no transform");
    SetPoint point;
    point.time_ns = begin_ns + one.time_from_start.toNSec();
    point.has_position = point.has_yaw = true;
    point.position_m = xyz(one.transforms[0].translation);
    const auto& q = one.transforms[0].rotation;
    point.yaw_rad = yaw_of_quaternion(q.x, q.y, q.z, q.w);
    if (!one.velocities.empty()) {
      point.has_velocity = point.has_yaw_rate = true;
      point.velocity_mps = xyz(one.velocities[0].linear);
      point.yaw_rate_radps = one.velocities[0].angular.z;
    }
    if (!one.accelerations.empty()) {
      point.has_acceleration = true;
      point.acceleration_mps2 = xyz(one.accelerations[0].linear);
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace ros_shim

#endif
