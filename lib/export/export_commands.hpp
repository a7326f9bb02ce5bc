#pragma once

#include <string>
#include <vector>

#include "trial/trial_observer.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

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
