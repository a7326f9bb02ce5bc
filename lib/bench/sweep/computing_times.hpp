#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plugin/call_times.hpp"
#include "store/rows.hpp"

namespace avoidbench {

/// What the calls of a sweep's planners took, summed up trial by trial from stored metrics.
class ComputingTimes {
 public:
  /// Nothing is summed up where `metrics` lack those of times.
  explicit ComputingTimes(std::span<const MetricRow> metrics);

  /// A trial with its values of the metrics; one without calls counts nothing.
  void add(const std::string& planner_key, std::span<const double> values);

  /// By planner key.
  std::map<std::string, CallTimes> by_planner() const;

 private:
  struct Sums {
    double count = 0.0, late_count = 0.0, wall_ms = 0.0, cpu_ms = 0.0;
  };
  std::vector<std::size_t> columns_;  ///< of kTimeMetrics; empty where one is missing
  std::map<std::string, Sums> sums_;
};

/// What a sweep's spec asks of its planners' calls.
struct TimeDemand {
  double plan_period_s = 0.0;  ///< 0: several
  double latency_s = 0.0;      ///< 0: none, or several
  bool is_charged = false;  ///< what a call takes is its latency: there is nothing to be late for
};
TimeDemand time_demand(std::string_view sweep_spec_json);

/// Warnings that a planner computes for longer than its flights let it; empty where it does not.
std::vector<std::string> computing_time_warnings(const std::string& label, const CallTimes& times,
                                                 const TimeDemand& demand);

}  // namespace avoidbench
