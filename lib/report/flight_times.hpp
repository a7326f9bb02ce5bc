#pragma once

#include <array>

#include "report/planner_summary.hpp"
#include "statistics/survival.hpp"

namespace avoidbench {

/// Times to the goal over all trials, failed ones too: a trial that failed has not arrived by any
/// time, so that failing early never looks fast. This is Kaplan–Meier's estimate with failures
/// followed up to the end of the longest trial.
struct FlightTimes {
  std::size_t planner = 0;
  std::array<double, 3> quartiles_s{};  ///< by when 25, 50, 75 % have arrived; infinite: never
  Interval median_interval_s;           ///< 95 %, where the curve's interval holds 50 %
  std::vector<SurvivalPoint> curve;     ///< share not yet arrived, at up to kMostCurvePoints times
};

inline constexpr std::size_t kMostCurvePoints = 200;

FlightTimes flight_times(std::size_t planner, const Trials& trials);

}  // namespace avoidbench
