#pragma once

#include "report/planner_summary.hpp"

namespace avoidbench {

/// Two planners compared by AvoidBench's contrast factor, eq. (10).
struct Contrast {
  std::size_t planner_1 = 0, planner_2 = 0;
  double factor = 0.0;           ///< NaN: undefined, a success rate is 0 or 1
  double smoothed_factor = 0.0;  ///< with Jeffreys-smoothed rates
  Interval smoothed_interval;    ///< BCa bootstrap over maps, 95 %; NaN for fewer than kLeastMaps
  double fisher_p = 1.0;         ///< that the success rates are equal, on missions like these
  /// The same on maps like these: Wilcoxon's test of the maps' rates; NaN for fewer than
  /// kLeastMapsToTest.
  double map_p = 1.0;

  bool is_clear() const { return fisher_p < kAlpha && !(map_p >= kAlpha); }
};

/// `trials_1` and `trials_2` are those that the summaries were made of.
Contrast contrast_of(const PlannerSummary& planner_1, const Trials& trials_1,
                     const PlannerSummary& planner_2, const Trials& trials_2);

}  // namespace avoidbench
