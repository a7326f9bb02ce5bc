#include "plugin/command_check.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace avoidbench {
namespace {

bool is_finite(const double (&v)[3]) {
  return std::all_of(std::begin(v), std::end(v), [](double x) { return std::isfinite(x); });
}

std::string yaw_problem(const ab_command& command) {
  if ((command.flags & AB_YAW_IS_RATE) != 0) {
    return std::isfinite(command.yaw_rate_radps) ? "" : "yaw_rate_radps is not finite";
  }
  return std::isfinite(command.yaw_rad) ? "" : "yaw_rad is not finite";
}

std::string point_problem(const ab_point& point) {
  if (!std::isfinite(point.time_s)) return "time_s is not finite";
  if (!is_finite(point.position_world_m)) return "position_world_m is not finite";
  if (!is_finite(point.velocity_world_mps)) return "velocity_world_mps is not finite";
  if (!is_finite(point.acceleration_world_mps2)) return "acceleration_world_mps2 is not finite";
  if (!is_finite(point.jerk_world_mps3)) return "jerk_world_mps3 is not finite";
  if (!std::isfinite(point.yaw_rad)) return "yaw_rad is not finite";
  return std::isfinite(point.yaw_rate_radps) ? "" : "yaw_rate_radps is not finite";
}

std::string trajectory_problem(const ab_command& command) {
  const std::string count = std::to_string(command.point_count);
  if (command.point_count < 2) return "a trajectory of " + count + " points; it needs at least 2";
  if (command.point_count > kMostTrajectoryPoints) {
    return "a trajectory of " + count + " points; at most " +
           std::to_string(kMostTrajectoryPoints) + " are read";
  }
  if (command.points == nullptr) return "a trajectory whose points are null";
  for (std::uint32_t i = 0; i < command.point_count; ++i) {
    const std::string place = "trajectory point " + std::to_string(i) + ": ";
    const std::string problem = point_problem(command.points[i]);
    if (!problem.empty()) return place + problem;
    if (i == 0 && command.points[0].time_s != 0.0) return place + "the first time is not 0";
    if (i > 0 && command.points[i].time_s <= command.points[i - 1].time_s) {
      return place + "times do not rise";
    }
  }
  return "";
}

}  // namespace

std::string command_kind_text(std::uint32_t kind) {
  switch (kind) {
    case AB_COMMAND_POSITION:
      return "position";
    case AB_COMMAND_VELOCITY:
      return "velocity";
    case AB_COMMAND_ACCELERATION:
      return "acceleration";
    case AB_COMMAND_TRAJECTORY:
      return "trajectory";
    case AB_COMMAND_RATES:
      return "rates";
    default:
      return "kind " + std::to_string(kind);
  }
}

std::string command_problem(const ab_command& command, std::uint32_t declared) {
  const std::string name = command_kind_text(command.kind);
  if (name.starts_with("kind ")) return "a command of the unknown " + name;
  if ((command.kind & declared) == 0) {
    return "a command of kind " + name + ", which the planner does not declare";
  }
  if ((command.flags & ~AB_YAW_IS_RATE) != 0) {
    return "a command with unknown flags " + std::to_string(command.flags);
  }
  if (!std::isfinite(command.horizon_s) || command.horizon_s < 0.0) {
    return "horizon_s is negative or not finite";
  }
  switch (command.kind) {
    case AB_COMMAND_POSITION:
      if (!is_finite(command.position_world_m)) return "position_world_m is not finite";
      return yaw_problem(command);
    case AB_COMMAND_VELOCITY:
      if (!is_finite(command.velocity_world_mps)) return "velocity_world_mps is not finite";
      return yaw_problem(command);
    case AB_COMMAND_ACCELERATION:
      if (!is_finite(command.acceleration_world_mps2)) {
        return "acceleration_world_mps2 is not finite";
      }
      return yaw_problem(command);
    case AB_COMMAND_TRAJECTORY:
      return trajectory_problem(command);
    default:
      if (!is_finite(command.rates_body_radps)) return "rates_body_radps is not finite";
      return std::isfinite(command.thrust_mps2) ? "" : "thrust_mps2 is not finite";
  }
}

}  // namespace avoidbench
