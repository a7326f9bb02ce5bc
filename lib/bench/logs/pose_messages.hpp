#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include "logs/message_reader.hpp"

namespace avoidbench {

/// The types of messages of ROS that have a vehicle's pose.
enum class PoseMessage {
  odometry,
  pose,
  pose_with_covariance,
  transform,
  transforms,
  px4_odometry,
  px4_local_position
};

/// The names of those types, for messages.
inline constexpr std::string_view kPoseMessageNames =
    "nav_msgs/Odometry, geometry_msgs/PoseStamped, geometry_msgs/PoseWithCovarianceStamped, "
    "geometry_msgs/TransformStamped, tf2_msgs/TFMessage, px4_msgs/VehicleOdometry and "
    "px4_msgs/VehicleLocalPosition";

/// The one that ROS 1 or ROS 2 calls `type` ("nav_msgs/Odometry", "nav_msgs/msg/Odometry"), or
/// nothing.
std::optional<PoseMessage> pose_message_of(std::string_view type);

/// A pose as a log has it; nothing is checked yet.
struct LoggedPose {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::int64_t time_ns = 0;                             ///< 0: it says none
  std::string_view frame, child_frame;                  ///< "" where the message has none
  Eigen::Vector3d position = {0, 0, 0};                 ///< m
  Eigen::Quaterniond q = {kNone, kNone, kNone, kNone};  ///< log frame from body
  std::optional<Eigen::Vector3d> velocity;              ///< m/s, in the log's frame
};

/// Whether it is a rotation, up to rounding. Programs without an attitude write zeros or NaN.
inline bool is_attitude(const Eigen::Quaterniond& q) { return std::abs(q.norm() - 1.0) < 0.1; }

/// Calls `use` with each pose of a message. Throws BadMessage where it is not of that type.
void read_pose_message(PoseMessage type, MessageReader message,
                       const std::function<void(const LoggedPose&)>& use);

// PX4's frames, North-East-Down and Forward-Right-Down, as the ones with z up.

inline Eigen::Vector3d enu_from_ned(const Eigen::Vector3d& v) { return {v.y(), v.x(), -v.z()}; }
inline Eigen::Vector3d flu_from_frd(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }
/// The attitude NED from FRD as ENU from FLU.
Eigen::Quaterniond enu_from_flu(const Eigen::Quaterniond& ned_from_frd);
/// The attitude FRD world from FRD body as FLU from FLU: with z up, and x where it was.
inline Eigen::Quaterniond flu_from_flu(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), -q.y(), -q.z()};
}

/// A PX4 pose and its velocity in a frame with z up.
/// `is_frd`: its world is Forward-Right-Down, of any heading, not North-East-Down.
/// `has_body_velocity`: its velocity is in the body's frame, not the world's.
LoggedPose with_z_up(LoggedPose pose, bool is_frd, bool has_body_velocity);

}  // namespace avoidbench
