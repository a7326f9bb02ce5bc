#include "sweep/standing_flights.hpp"

#include <algorithm>

#include "base/number_text.hpp"

namespace avoidbench {
namespace {

constexpr std::string_view kMetrics[] = {"mean_speed_mps", "plan_call_count", "no_plan_count"};
constexpr double kStanding_mps = 0.1;

}  // namespace

StandingFlights::StandingFlights(std::span<const MetricRow> metrics) {
  for (const std::string_view name : kMetrics) {
    const auto found = std::find_if(metrics.begin(), metrics.end(),
                                    [&](const MetricRow& metric) { return metric.name == name; });
    if (found == metrics.end()) {
      columns_.clear();
      return;
    }
    columns_.push_back(static_cast<std::size_t>(found - metrics.begin()));
  }
}

void StandingFlights::add(const std::string& planner_key, Outcome outcome,
                          std::span<const double> values) {
  if (columns_.empty()) return;
  const double speed_mps = values[columns_[0]], calls = values[columns_[1]],
               without_plan = values[columns_[2]];
  StandingCounts& counts = counts_[planner_key];
  ++counts.trials;
  if (outcome == Outcome::timed_out && speed_mps < kStanding_mps) ++counts.standing;
  if (calls > 0.0 && without_plan == calls) ++counts.silent;
}

std::vector<std::string> standing_warnings(const std::string& label, const StandingCounts& counts) {
  const std::string of_all = " of " + std::to_string(counts.trials) + " trials";
  std::vector<std::string> warnings;
  if (counts.standing > 0) {
    warnings.push_back(label + " stood still until the time was up in " +
                       std::to_string(counts.standing) + of_all + " (mean speed below " +
                       shortest(kStanding_mps) +
                       " m/s): `avoidbench replay` shows what it saw, `avoidbench explain` why");
  }
  if (counts.silent > 0) {
    warnings.push_back(label + " gave no command at all in " + std::to_string(counts.silent) +
                       of_all);
  }
  return warnings;
}

}  // namespace avoidbench
