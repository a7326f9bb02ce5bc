#pragma once

#include "report/planner_summary.hpp"

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

}  // namespace avoidbench
