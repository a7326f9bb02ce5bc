#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/enum_text.hpp"
#include "trial/trial_observer.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

enum class TrajectoryFormat { csv, tum };
template <>
struct EnumText<TrajectoryFormat> {
  static constexpr std::pair<TrajectoryFormat, std::string_view> entries[] = {
      {TrajectoryFormat::csv, "csv"}, {TrajectoryFormat::tum, "tum"}};
};

/// The flown path as CSV (RFC 4180), a row a sample, all that is stored of it and the yaw.
/// Position, velocity and acceleration in the world frame (ENU, z up); q turns body (FLU) to world
/// coordinates; body rates in the body frame; the reference is the commanded position, empty where
/// the command has none.
std::string trajectory_csv(std::span<const Sample> samples);

/// The flown path as the TUM RGB-D benchmark writes trajectories and evo reads them: a line a
/// sample, `timestamp tx ty tz qx qy qz qw`, s and m, position of the body in the world frame, q
/// from body to world coordinates.
std::string trajectory_tum(std::span<const Sample> samples);

std::string trajectory_text(std::span<const Sample> samples, TrajectoryFormat format);

/// The planner's calls as CSV (RFC 4180), a row a call. CPU and wall time were measured on the
/// host.
std::string plan_calls_csv(std::span<const PlanCall> calls);

/// One plan call in words, for commands_csv.
struct CommandLine {
  double time_s = 0.0, effect_s = 0.0, cpu_time_s = 0.0;
  PlanStatus status = PlanStatus::error;
  ab_command command{};
  std::vector<ab_point> points;
};
CommandLine command_line(const PlanStep& step);

/// The planner's calls as CSV, a row a call. Position, velocity and acceleration are those of a
/// trajectory's first point, or of the command itself; empty where the kind has none.
std::string commands_csv(const std::vector<CommandLine>& calls);

}  // namespace avoidbench
