#include "replay_lines.hpp"

#include <algorithm>
#include <cmath>

#include "text/number_text.hpp"
#include "text/visible_text.hpp"

namespace avoidbench {

std::string outcome_line(const TrialRecord& record) {
  std::string line = std::string(text(record.outcome));
  if (!std::isnan(record.end_time_s)) line += " at " + fixed_digits(record.end_time_s, 3) + " s";
  return record.reason.empty() ? line : line + ": " + visible_line(record.reason);
}

std::string calls_line(const std::vector<CommandLine>& calls) {
  std::size_t commands = 0, no_plans = 0;
  double sum_s = 0.0, most_s = 0.0;
  for (const CommandLine& call : calls) {
    commands += call.status == PlanStatus::command ? 1 : 0;
    no_plans += call.status == PlanStatus::no_plan ? 1 : 0;
    sum_s += call.cpu_time_s;
    most_s = std::max(most_s, call.cpu_time_s);
  }
  if (calls.empty()) return "none";
  const double mean_s = sum_s / static_cast<double>(calls.size());
  return std::to_string(calls.size()) + ", of them " + std::to_string(commands) + " commands and " +
         std::to_string(no_plans) + " without a plan; CPU " + fixed_digits(1000.0 * mean_s, 2) +
         " ms, most " + fixed_digits(1000.0 * most_s, 2) + " ms";
}

std::string place_line(const Sample& sample) {
  const Eigen::Vector3d& place = sample.position_world;
  return "(" + fixed_digits(place.x(), 2) + ", " + fixed_digits(place.y(), 2) + ", " +
         fixed_digits(place.z(), 2) + ") m, " + fixed_digits(sample.velocity_world.norm(), 2) +
         " m/s, " + fixed_digits(sample.clearance_m, 2) + " m from the nearest surface, at " +
         fixed_digits(sample.time_s, 3) + " s";
}

}  // namespace avoidbench
