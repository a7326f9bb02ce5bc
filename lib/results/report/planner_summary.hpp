#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "statistics/interval.hpp"
#include "statistics/reached_speed.hpp"
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
  /// BCa bootstrap over maps, 95 %; NaN for fewer than kLeastMaps maps, an end that can't be told
  Interval interval;
  double standard_deviation = 0.0;  ///< of the values, n - 1
  std::int64_t count = 0;
  bool is_best = false;  ///< and significantly better than that of every other planner
};

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

/// Trials and successes on one map.
struct MapCount {
  std::size_t map = 0;
  std::int64_t trials = 0, finished = 0;
  double reference_length_m = 0.0;  ///< of all these trials

  double rate() const { return static_cast<double>(finished) / static_cast<double>(trials); }
};

/// Of each map that the trials are on, in order of maps.
std::vector<MapCount> counts_by_map(const Trials& trials);

/// Maps from which on a test over them can find anything (p < kAlpha): with five even five equal
/// differences are p = 0.0625.
inline constexpr std::size_t kLeastMapsToTest = 6;

/// Marks what is significantly best among planners that flew the same missions: rates by Fisher's
/// exact test and, from kLeastMapsToTest maps on, by Wilcoxon's of the maps' rates too, means by
/// Wilcoxon's signed-rank test on the missions that both have, p Bonferroni corrected. `trials` has
/// the trials of each of `planners`; `metrics` are those of planner_summary(), `rows` the
/// definitions of all.
void mark_best(std::vector<PlannerSummary>& planners, std::span<const Trials> trials,
               std::span<const std::size_t> metrics, std::span<const MetricRow> rows);

/// Two planners compared by AvoidBench's contrast factor, eq. (10).
struct Contrast {
  std::size_t planner_1 = 0, planner_2 = 0;
  double factor = 0.0;           ///< NaN: undefined, a success rate is 0 or 1
  double smoothed_factor = 0.0;  ///< with Jeffreys-smoothed rates
  Interval smoothed_interval;    ///< BCa bootstrap over maps, 95 %; NaN as in MetricMean
  double fisher_p = 1.0;         ///< that the success rates are equal, on missions like these
  /// The same on maps like these: Wilcoxon's test of the maps' rates; NaN for fewer than
  /// kLeastMapsToTest.
  double map_p = 1.0;
  SpeedDifference v90 = {};  ///< NaN where either has none

  bool is_clear() const { return fisher_p < kAlpha && !(map_p >= kAlpha); }
};

/// `trials_1` and `trials_2` are those that the summaries were made of.
Contrast contrast_of(const PlannerSummary& planner_1, const Trials& trials_1,
                     const PlannerSummary& planner_2, const Trials& trials_2);

}  // namespace avoidbench
