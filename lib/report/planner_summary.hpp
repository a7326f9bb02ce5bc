#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "statistics/interval.hpp"
#include "store/rows.hpp"

namespace avoidbench {

inline constexpr std::size_t kOutcomeCount = std::size(EnumText<Outcome>::entries);
inline constexpr double kAlpha = 0.05;  ///< level of every test of a report

/// A trial, and its map as an index into SweepResult::maps.
struct TrialOnMap {
  const TrialSummary* trial = nullptr;
  std::size_t map = 0;
};
using Trials = std::vector<TrialOnMap>;  ///< in order of map, then mission

/// A metric over the trials that it speaks of; NaN where there are none.
struct MetricMean {
  double mean = 0.0;
  Interval interval;  ///< BCa bootstrap over maps, 95 %; NaN for fewer than kLeastMaps maps
  double standard_deviation = 0.0;  ///< of the values, n - 1
  std::int64_t count = 0;
  bool is_best = false;  ///< and significantly better than that of every other planner
};

/// Maps from which on an interval over maps is given: fewer say too little of how maps differ.
inline constexpr std::size_t kLeastMaps = 5;

/// One planner's trials, all or those of one group.
struct PlannerSummary {
  std::size_t planner = 0;  ///< index into SweepSummary::planners
  std::int64_t trial_count = 0, finished_count = 0;
  double success_rate = 0.0;  ///< NaN without trials
  Interval success_interval;  ///< 95 %: Wilson, for maps like these where there are kLeastMaps
  bool is_best_rate = false;  ///< significantly above every other planner's
  double mean_reference_length_m = 0.0;
  std::vector<MetricMean> means;  ///< one a metric of SweepSummary::metrics
  std::array<std::int64_t, kOutcomeCount> outcome_counts{};  ///< in order of Outcome
};

/// The trials' summary, with the metrics of these indices into SweepResult::metrics.
PlannerSummary planner_summary(std::size_t planner, const Trials& trials,
                               std::span<const std::size_t> metrics);

/// How much greater `a`'s success rate is than `b`'s on each map that both flew.
std::vector<double> rate_differences(const Trials& a, const Trials& b);

/// Maps from which on a test over them can find anything (p < kAlpha).
inline constexpr std::size_t kLeastMapsToTest = 6;

/// Marks what is significantly best among planners that flew the same missions: rates by Fisher's
/// exact test and, from kLeastMapsToTest maps on, by Wilcoxon's of the maps' rates too, means by
/// Wilcoxon's signed-rank test on the missions that both have, p Bonferroni corrected. `trials` has
/// the trials of each of `planners`; `metrics` are those of planner_summary(), `rows` their
/// definitions.
void mark_best(std::vector<PlannerSummary>& planners, std::span<const Trials> trials,
               std::span<const std::size_t> metrics, std::span<const MetricRow> rows);

}  // namespace avoidbench
