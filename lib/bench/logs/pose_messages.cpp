#include "logs/pose_messages.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace avoidbench {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

Eigen::Vector3d read_vector(MessageReader& message) {
  const double x = message.number<double>(), y = message.number<double>();
  return {x, y, message.number<double>()};
}

/// ROS writes x, y, z, w.
Eigen::Quaterniond read_ros_attitude(MessageReader& message) {
  const Eigen::Vector3d v = read_vector(message);
  return {message.number<double>(), v.x(), v.y(), v.z()};
}

Eigen::Vector3d read_float_vector(MessageReader& message) {
  const float x = message.number<float>(), y = message.number<float>();
  return Eigen::Vector3f(x, y, message.number<float>()).cast<double>();
}

/// std_msgs/Header.
LoggedPose read_header(MessageReader& message) {
  LoggedPose pose;
  if (!message.is_cdr()) message.number<std::uint32_t>();  // seq
  const std::int64_t seconds = message.is_cdr() ? message.number<std::int32_t>()
                                                : std::int64_t{message.number<std::uint32_t>()};
  pose.time_ns = seconds * kNanosecondsPerSecond + message.number<std::uint32_t>();
  pose.frame = message.text();
  return pose;
}

LoggedPose read_transform(MessageReader& message) {
  LoggedPose pose = read_header(message);
  pose.child_frame = message.text();
  pose.position = read_vector(message);
  pose.q = read_ros_attitude(message);
  return pose;
}

/// A vector in the body's frame in the frame of the attitude; NaN where that is none.
Eigen::Vector3d from_body(const Eigen::Quaterniond& q, const Eigen::Vector3d& v) {
  if (!is_attitude(q)) return Eigen::Vector3d::Constant(LoggedPose::kNone);
  return q.normalized() * v;
}

LoggedPose read_odometry(MessageReader& message) {
  LoggedPose pose = read_header(message);
  pose.child_frame = message.text();
  pose.position = read_vector(message);
  pose.q = read_ros_attitude(message);
  message.skip_doubles(36);
  pose.velocity = from_body(pose.q, read_vector(message));
  message.skip_doubles(3 + 36);
  return pose;
}

std::int64_t read_px4_time(MessageReader& message) {
  constexpr std::uint64_t kMost_us = std::uint64_t{1} << 53U;  // 285 years
  const auto time_us = message.number<std::uint64_t>();
  message.number<std::uint64_t>();  // timestamp_sample
  if (time_us > kMost_us) throw BadMessage("its time is beyond all bounds");
  return static_cast<std::int64_t>(time_us) * 1000;
}

/// As PX4 has it since version 1.14. Before, covariances made the message far longer.
LoggedPose read_px4_odometry(MessageReader& message) {
  constexpr std::size_t kLongest = 128;
  if (message.left() > kLongest) {
    throw BadMessage("px4_msgs/VehicleOdometry from before PX4 1.14, which is not supported");
  }
  LoggedPose pose;
  pose.time_ns = read_px4_time(message);
  const auto frame = message.number<std::uint8_t>();
  pose.position = read_float_vector(message);
  const auto w = static_cast<double>(message.number<float>());
  const Eigen::Vector3d v = read_float_vector(message);
  pose.q = {w, v.x(), v.y(), v.z()};
  const auto velocity_frame = message.number<std::uint8_t>();
  pose.velocity = read_float_vector(message);
  return with_z_up(pose, frame == 2, velocity_frame == 3);
}

LoggedPose read_px4_local_position(MessageReader& message) {
  LoggedPose pose;
  pose.time_ns = read_px4_time(message);
  bool is_valid[4];  // xy, z, v_xy, v_z
  for (bool& valid : is_valid) valid = message.number<std::uint8_t>() != 0;
  pose.position = read_float_vector(message);
  if (!is_valid[0] || !is_valid[1]) pose.position.setConstant(LoggedPose::kNone);
  for (int i = 0; i < 2; ++i) message.number<float>();  // delta_xy
  message.number<std::uint8_t>();                       // xy_reset_counter
  message.number<float>();                              // delta_z
  message.number<std::uint8_t>();                       // z_reset_counter
  pose.velocity = read_float_vector(message);
  if (!is_valid[2] || !is_valid[3]) pose.velocity->setConstant(LoggedPose::kNone);
  return with_z_up(pose, false, false);
}

/// PX4's messages grow at their end from version to version; the others end with their last field,
/// but for what CDR fills up with.
void check_is_read(const MessageReader& message) {
  if (message.left() >= (message.is_cdr() ? 8 : 1)) {
    throw BadMessage("it is longer than its type");
  }
}

}  // namespace

std::optional<PoseMessage> pose_message_of(std::string_view type) {
  constexpr std::pair<std::string_view, PoseMessage> kTypes[] = {
      {"nav_msgs/Odometry", PoseMessage::odometry},
      {"geometry_msgs/PoseStamped", PoseMessage::pose},
      {"geometry_msgs/PoseWithCovarianceStamped", PoseMessage::pose_with_covariance},
      {"geometry_msgs/TransformStamped", PoseMessage::transform},
      {"tf2_msgs/TFMessage", PoseMessage::transforms},
      {"tf/tfMessage", PoseMessage::transforms},
      {"px4_msgs/VehicleOdometry", PoseMessage::px4_odometry},
      {"px4_msgs/VehicleLocalPosition", PoseMessage::px4_local_position}};
  constexpr std::string_view kMiddle = "/msg/";  // of ROS 2
  std::string name(type);
  if (const std::size_t place = name.find(kMiddle); place != std::string::npos) {
    name.replace(place, kMiddle.size(), "/");
  }
  for (const auto& [known, message] : kTypes) {
    if (name == known) return message;
  }
  return std::nullopt;
}

void read_pose_message(PoseMessage type, MessageReader message,
                       const std::function<void(const LoggedPose&)>& use) {
  LoggedPose pose;
  switch (type) {
    case PoseMessage::odometry:
      pose = read_odometry(message);
      break;
    case PoseMessage::pose:
    case PoseMessage::pose_with_covariance:
      pose = read_header(message);
      pose.position = read_vector(message);
      pose.q = read_ros_attitude(message);
      if (type == PoseMessage::pose_with_covariance) message.skip_doubles(36);
      break;
    case PoseMessage::transform:
      pose = read_transform(message);
      break;
    case PoseMessage::transforms: {
      // Each takes bytes, so that a count beyond them ends with the message.
      const auto count = message.number<std::uint32_t>();
      for (std::uint32_t i = 0; i < count; ++i) use(read_transform(message));
      check_is_read(message);
      return;
    }
    case PoseMessage::px4_odometry:
      use(read_px4_odometry(message));
      return;
    case PoseMessage::px4_local_position:
      use(read_px4_local_position(message));
      return;
  }
  check_is_read(message);
  use(pose);
}

Eigen::Quaterniond enu_from_flu(const Eigen::Quaterniond& ned_from_frd) {
  constexpr double kHalfRoot = std::numbers::sqrt2 / 2.0;
  // Half turns about the line between north and east, and about forward.
  const Eigen::Quaterniond enu_from_ned_turn(0.0, kHalfRoot, kHalfRoot, 0.0);
  const Eigen::Quaterniond frd_from_flu_turn(0.0, 1.0, 0.0, 0.0);
  return enu_from_ned_turn * ned_from_frd * frd_from_flu_turn;
}

LoggedPose with_z_up(LoggedPose pose, bool is_frd, bool has_body_velocity) {
  if (pose.velocity && has_body_velocity) pose.velocity = from_body(pose.q, *pose.velocity);
  const auto turned = is_frd ? flu_from_frd : enu_from_ned;
  pose.position = turned(pose.position);
  if (pose.velocity) pose.velocity = turned(*pose.velocity);
  pose.q = is_frd ? flu_from_flu(pose.q) : enu_from_flu(pose.q);
  return pose;
}

}  // namespace avoidbench
