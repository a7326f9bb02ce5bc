#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "store/rows.hpp"

namespace avoidbench {

/// How many of a planner's trials were no flights, as of one that sees nothing that it can use.
struct StandingCounts {
  std::int64_t trials = 0;
  std::int64_t standing = 0;  ///< out of time, at a mean speed below 0.1 m/s
  std::int64_t silent = 0;    ///< no call gave a command
};

/// Counts a sweep's trials by planner, from stored metrics.
class StandingFlights {
 public:
  /// Nothing is counted where `metrics` lack those that tell.
  explicit StandingFlights(std::span<const MetricRow> metrics);

  void add(const std::string& planner_key, Outcome outcome, std::span<const double> values);
  /// By planner key.
  const std::map<std::string, StandingCounts>& by_planner() const { return counts_; }

 private:
  std::vector<std::size_t> columns_;  ///< of kMetrics; empty where one is missing
  std::map<std::string, StandingCounts> counts_;
};

/// Warnings of trials in which the planner never flew; empty where there are none.
std::vector<std::string> standing_warnings(const std::string& label, const StandingCounts& counts);

}  // namespace avoidbench
