#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "base/enum_text.hpp"
#include "base/ticks.hpp"

namespace avoidbench {

/// What a planner steers with; the five ways of its interface.
enum class CommandKind { position, velocity, acceleration, trajectory, rates };

template <>
struct EnumText<CommandKind> {
  static constexpr std::pair<CommandKind, std::string_view> entries[] = {
      {CommandKind::position, "position"},
      {CommandKind::velocity, "velocity"},
      {CommandKind::acceleration, "acceleration"},
      {CommandKind::trajectory, "trajectory"},
      {CommandKind::rates, "rates"}};
};

struct TrajectoryPoint {
  double time_s = 0.0;  ///< after the command's start
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d jerk_world = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double yaw_rate_radps = 0.0;
};

/// One command; only the fields of its kind count. Position, velocity and acceleration commands go
/// with `yaw_rad`, or with `yaw_rate_radps` where `yaw_is_rate`.
struct Command {
  CommandKind kind = CommandKind::velocity;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_world = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double yaw_rate_radps = 0.0;
  bool yaw_is_rate = false;
  Eigen::Vector3d rates_body_radps = Eigen::Vector3d::Zero();
  double thrust_mps2 = 0.0;  ///< collective, over mass: g hovers
  std::vector<TrajectoryPoint> trajectory;
  double horizon_s = 0.0;  ///< this long after its start the vehicle brakes; 0: never
  Tick start_tick = 0;
};

/// Why this command can't be tracked (a number of its kind that is not finite, a trajectory of
/// fewer than two points or with times that do not rise from zero or above), or "".
std::string command_problem(const Command& command);

}  // namespace avoidbench
