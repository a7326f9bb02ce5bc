#pragma once

#include <vector>

#include "report/planner_summary.hpp"
#include "statistics/reached_speed.hpp"
#include "store/database.hpp"

namespace avoidbench {

/// A number with its 95 % interval; NaN where the flights are too few for it.
struct Estimate {
  double value = 0.0;
  Interval interval;
};

/// How fast a planner reaches its goals: S(v), the share of missions with at least the goal
/// velocity v (d_min / T where the goal was reached, else 0), and what is read from it.
struct PlannerSpeeds {
  std::size_t planner = 0;  ///< index into SweepSummary::planners
  std::int64_t trial_count = 0;
  Estimate v90, v50;     ///< m/s
  Estimate mean;         ///< m/s, of all missions, failures as 0: the area under S(v)
  bool is_best = false;  ///< v90 clearly above every other planner's
  std::int64_t crash_count = 0;
  double flown_km = 0.0;
  Estimate crashes_per_km;  ///< exact Poisson interval, as if flights were independent
  std::vector<SpeedStep> curve;
  std::vector<double> v90_draws;  ///< see reached_speed_draws(): pairs with other planners' draws
};

/// Of flights on maps below `map_count`, with so many collisions over so long a way. Another
/// `stream_index` draws other maps for v90_draws.
PlannerSpeeds speeds_of(const std::vector<SpeedTrial>& trials, std::int64_t crash_count,
                        double flown_m, std::size_t map_count, std::uint64_t stream_index = 0);

/// One a planner, in their order; empty where the results lack the metrics. `map_count` is that of
/// the result, so that draws pair. Marks the best.
std::vector<PlannerSpeeds> planner_speeds(const SweepResult& result,
                                          const std::vector<Trials>& planners);

/// Of two planners' v90; NaN where one has none.
SpeedDifference v90_difference(const PlannerSpeeds& first, const PlannerSpeeds& second,
                               std::size_t map_count, double confidence = 0.95);

/// Several settings of one planner (its other parameters equal or not): which has the greatest v90.
struct BestSetting {
  std::size_t best = 0;  ///< index into the speeds
  std::size_t setting_count = 0;
};
std::vector<BestSetting> best_settings(const std::vector<PlannerSpeeds>& speeds,
                                       const std::vector<PlannerRow>& planners);

}  // namespace avoidbench
