#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plugin/call_times.hpp"
#include "store/rows.hpp"

namespace avoidbench {

/// What a planner's trials show besides results. A sum is 0 where a database lacks its metrics.
struct PlannerTally {
  std::int64_t trials = 0;
  std::int64_t standing = 0;  ///< out of time, at a mean speed below 0.1 m/s
  std::int64_t silent = 0;    ///< no call gave a command
  /// Over all calls of trials whose times were measured.
  double calls = 0.0, late_calls = 0.0, wall_ms = 0.0, cpu_ms = 0.0;

  CallTimes call_times() const;
};

/// Sums up a sweep's trials by planner, from stored metrics.
class PlannerTallies {
 public:
  explicit PlannerTallies(std::span<const MetricRow> metrics);

  void add(const std::string& planner_key, Outcome outcome, std::span<const double> values);
  /// By planner key.
  const std::map<std::string, PlannerTally>& by_planner() const { return tallies_; }

  /// Warnings of planners that never flew in a trial, then of those that compute for longer than
  /// their flights let them. `planners`: keys and labels, in the order of the warnings.
  std::vector<std::string> warnings(
      const std::vector<std::pair<std::string, std::string>>& planners,
      std::string_view sweep_spec_json) const;

 private:
  std::vector<std::size_t> standing_columns_, time_columns_;  ///< empty where one is missing
  std::map<std::string, PlannerTally> tallies_;
};

/// What a sweep's spec asks of its planners' calls.
struct TimeDemand {
  double plan_period_s = 0.0;  ///< 0: several
  double latency_s = 0.0;      ///< 0: none, or several
  bool is_charged = false;  ///< what a call takes is its latency: there is nothing to be late for
};
TimeDemand time_demand(std::string_view sweep_spec_json);

}  // namespace avoidbench
