#pragma once

#include <array>

#include "report/planner_summary.hpp"
#include "statistics/survival.hpp"

namespace avoidbench {

/// How a planner's success depends on how hard the map is: success ~ logistic(normalised
/// traversability), fitted to the maps' counts, and the rank correlation of the maps' success rates
/// with it.
struct DifficultyResponse {
  std::size_t planner = 0;
  std::int64_t map_count = 0;  ///< with measured traversability
  double intercept = 0.0,
         slope = 0.0;          ///< log odds; a unit of traversability; NaN where no fit exists
  double midpoint = 0.0;       ///< normalised traversability at which half of the trials succeed
  Interval midpoint_interval;  ///< Fieller, 95 %; infinite where the data leave it open
  double spearman = 0.0;       ///< NaN where all maps have the same rate
  Interval spearman_interval;
  bool is_separated = false;  ///< success and failure do not overlap: no finite fit
};

DifficultyResponse difficulty_response(std::size_t planner, const Trials& trials,
                                       const std::vector<MapRow>& maps);

/// Times to the goal over all trials, failed ones too: a trial that failed has not arrived by any
/// time, so that failing early never looks fast. This is Kaplan–Meier's estimate with failures
/// followed up to the end of the longest trial.
struct FlightTimes {
  std::size_t planner = 0;
  std::array<double, 3> quartiles_s{};  ///< by when 25, 50, 75 % have arrived; infinite: never
  Interval median_interval_s;           ///< 95 %, where the curve's interval holds 50 %
  std::vector<SurvivalPoint> curve;     ///< share not yet arrived, at up to 200 times
};

FlightTimes flight_times(std::size_t planner, const Trials& trials);

}  // namespace avoidbench
