#include "control/command.hpp"

#include <cmath>

namespace avoidbench {
namespace {

/// The first thing that is wrong, or "".
std::string trajectory_problem(const std::vector<TrajectoryPoint>& points) {
  if (points.size() < 2) return "a trajectory of fewer than two points";
  double before_s = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TrajectoryPoint& point = points[i];
    const std::string name = "trajectory point " + std::to_string(i);
    if (!(point.position_world.allFinite() && point.velocity_world.allFinite() &&
          point.acceleration_world.allFinite() && std::isfinite(point.time_s) &&
          std::isfinite(point.yaw_rad) && std::isfinite(point.yaw_rate_radps))) {
      return name + " is not finite";
    }
    if (point.time_s < 0.0) return name + " has a negative time";
    if (i > 0 && !(point.time_s > before_s)) return name + " is not later than the one before";
    before_s = point.time_s;
  }
  return {};
}

}  // namespace

std::string command_problem(const Command& command) {
  if (!(std::isfinite(command.horizon_s) && command.horizon_s >= 0.0)) {
    return "horizon_s is negative or not finite";
  }
  // Angles beyond this have lost their meaning, and sine and cosine their precision.
  constexpr double kMostYawRad = 1e5;
  if (command.kind == CommandKind::rates) {
    if (!(command.rates_body_radps.allFinite() && std::isfinite(command.thrust_mps2))) {
      return "rates or thrust are not finite";
    }
    return {};
  }
  if (command.kind == CommandKind::trajectory) {
    for (const TrajectoryPoint& point : command.trajectory) {
      if (std::abs(point.yaw_rad) > kMostYawRad) return "a trajectory's yaw is beyond 1e5 rad";
    }
    return trajectory_problem(command.trajectory);
  }
  const Eigen::Vector3d& goal = command.kind == CommandKind::position ? command.position_world
                                : command.kind == CommandKind::velocity
                                    ? command.velocity_world
                                    : command.acceleration_world;
  if (!goal.allFinite()) return std::string(text(command.kind)) + " is not finite";
  const double yaw = command.yaw_is_rate ? command.yaw_rate_radps : command.yaw_rad;
  if (!(std::abs(yaw) <= kMostYawRad)) return "yaw is not finite or beyond 1e5";
  return {};
}

}  // namespace avoidbench
