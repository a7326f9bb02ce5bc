#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "statistics/interval.hpp"
#include "store/rows.hpp"

namespace avoidbench {

inline constexpr std::size_t kOutcomeCount = std::size(EnumText<Outcome>::entries);

/// A metric over the trials that it speaks of; NaN where there are none.
struct MetricMean {
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< of the values, n - 1
  std::int64_t count = 0;
  bool is_best = false;  ///< and significantly better than that of every other planner
};

/// One planner's trials, all or those of one group of maps.
struct PlannerSummary {
  std::size_t planner = 0;  ///< index into SweepSummary::planners
  std::int64_t trial_count = 0, finished_count = 0;
  double success_rate = 0.0;  ///< NaN without trials
  Interval success_interval;  ///< Wilson, 95 %
  bool is_best_rate = false;  ///< significantly above every other planner's
  double mean_reference_length_m = 0.0;
  std::vector<MetricMean> means;  ///< one a metric of SweepSummary::metrics
  std::array<std::int64_t, kOutcomeCount> outcome_counts{};  ///< in order of Outcome
};

/// Maps of like difficulty, and how each planner fared there.
struct MapGroup {
  std::int64_t map_count = 0;
  double lowest_ratio = 0.0, highest_ratio = 0.0;  ///< of their traversability_normalized_ratio
  std::vector<PlannerSummary> planners;
};

/// Two planners compared by AvoidBench's contrast factor, eq. (10).
struct Contrast {
  std::size_t planner_1 = 0, planner_2 = 0;
  double factor = 0.0;           ///< NaN: undefined, a success rate is 0 or 1
  double smoothed_factor = 0.0;  ///< with Jeffreys-smoothed rates
  Interval smoothed_interval;    ///< bootstrap over maps, 95 %; NaN for fewer than 2 maps
  double fisher_p = 1.0;         ///< that the success rates are equal
};

/// What a report says of one sweep.
struct SweepSummary {
  std::string name;
  std::int64_t revision = 1;
  std::vector<MetricRow> metrics;  ///< those that were asked for
  std::vector<std::string>
      planners;  ///< labels; with the start of the key where two planners share one
  std::int64_t map_count = 0, mission_count = 0, invalid_mission_count = 0, trial_count = 0;
  std::vector<PlannerSummary> overall;
  std::vector<MapGroup> groups;  ///< from hard to easy maps; empty for fewer than 2 maps
  std::vector<Contrast> contrasts;
  std::vector<std::string> warnings;
};

/// Those of the usual metrics that `result` has: path and energy optimality, average goal velocity,
/// mission progress, processing time.
std::vector<std::string> default_metrics(const SweepResult& result);

/// The summary, with these metrics. Throws InputError for a metric that the results lack.
SweepSummary summarize(const SweepResult& result, std::span<const std::string> metric_names);

/// One sweep's trials out of several databases (shards); a trial that several have counts once.
/// Throws InputError when they define metrics differently.
SweepResult combined(std::span<const SweepResult> parts);

}  // namespace avoidbench
