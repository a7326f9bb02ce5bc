#include "plugin/command_check.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/number_text.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

/// Why a number of a command can't be meant; "" where it can.
std::string number_problem(const char* name, double value, double most = kMostOfCommand) {
  if (!std::isfinite(value)) return std::string(name) + " is not finite";
  if (std::abs(value) <= most) return "";
  return std::string(name) + " is " + significant_digits(value, 3) + ", beyond ±" +
         significant_digits(most, 3) + ": no such command is meant";
}

std::string vector_problem(const char* name, const double (&v)[3]) {
  for (const double x : v) {
    std::string problem = number_problem(name, x);
    if (!problem.empty()) return problem;
  }
  return "";
}

std::string yaw_problem(const ab_command& command) {
  return (command.flags & AB_YAW_IS_RATE) != 0
             ? number_problem("yaw_rate_radps", command.yaw_rate_radps, kMostYaw)
             : number_problem("yaw_rad", command.yaw_rad, kMostYaw);
}

/// The first of them that is one.
std::string first_problem(std::initializer_list<std::string> problems) {
  for (const std::string& problem : problems) {
    if (!problem.empty()) return problem;
  }
  return "";
}

std::string point_problem(const ab_point& point) {
  return first_problem({number_problem("time_s", point.time_s),
                        vector_problem("position_world_m", point.position_world_m),
                        vector_problem("velocity_world_mps", point.velocity_world_mps),
                        vector_problem("acceleration_world_mps2", point.acceleration_world_mps2),
                        vector_problem("jerk_world_mps3", point.jerk_world_mps3),
                        number_problem("yaw_rad", point.yaw_rad, kMostYaw),
                        number_problem("yaw_rate_radps", point.yaw_rate_radps, kMostYaw)});
}

/// What two points mean together: the cubic between them swings out by up to 4/27 of a rate times
/// the time, and the tracker has no precise sine and cosine of far angles.
std::string turn_problem(const ab_point& from, const ab_point& to) {
  const double rate_radps = std::max(std::abs(from.yaw_rate_radps), std::abs(to.yaw_rate_radps));
  return number_problem("yaw_rate_radps times the time between the points",
                        rate_radps * (to.time_s - from.time_s), kMostYaw);
}

std::string trajectory_problem(const ab_command& command) {
  const std::string count = counted(command.point_count, "point");
  if (command.point_count < 2) return "a trajectory of " + count + "; it needs at least 2";
  if (command.point_count > kMostTrajectoryPoints) {
    return "a trajectory of " + count + "; at most " + std::to_string(kMostTrajectoryPoints) +
           " are read";
  }
  if (command.points == nullptr) return "a trajectory whose points are null";
  for (std::uint32_t i = 0; i < command.point_count; ++i) {
    const std::string place = "trajectory point " + std::to_string(i) + ": ";
    const std::string problem = point_problem(command.points[i]);
    if (!problem.empty()) return place + problem;
    // Exactly: a trajectory begins when the command takes effect (planner.h).
    if (i == 0 && command.points[0].time_s != 0.0) return place + "the first time is not 0";
    if (i > 0 && command.points[i].time_s <= command.points[i - 1].time_s) {
      return place + "times do not rise";
    }
    const std::string turn =
        i > 0 ? turn_problem(command.points[i - 1], command.points[i]) : std::string();
    if (!turn.empty()) return place + turn;
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
  // command_kind_text() gives a number only to what is no kind.
  if (name.starts_with("kind ")) return "a command of the unknown " + name;
  if ((command.kind & declared) == 0) {
    return "a command of kind " + name + ", which the planner does not declare";
  }
  // Not passed over: a planner that means more by a flag would be flown otherwise.
  if ((command.flags & ~AB_YAW_IS_RATE) != 0) {
    return "a command with unknown flags " + std::to_string(command.flags);
  }
  if (!std::isfinite(command.horizon_s) || command.horizon_s < 0.0) {
    return "horizon_s is negative or not finite";
  }
  switch (command.kind) {
    case AB_COMMAND_POSITION:
      return first_problem(
          {vector_problem("position_world_m", command.position_world_m), yaw_problem(command)});
    case AB_COMMAND_VELOCITY:
      return first_problem(
          {vector_problem("velocity_world_mps", command.velocity_world_mps), yaw_problem(command)});
    case AB_COMMAND_ACCELERATION:
      return first_problem(
          {vector_problem("acceleration_world_mps2", command.acceleration_world_mps2),
           yaw_problem(command)});
    case AB_COMMAND_TRAJECTORY:
      return trajectory_problem(command);
    default:
      return first_problem({vector_problem("rates_body_radps", command.rates_body_radps),
                            number_problem("thrust_mps2", command.thrust_mps2)});
  }
}

}  // namespace avoidbench
