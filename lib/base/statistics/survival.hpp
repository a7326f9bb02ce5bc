#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/interval.hpp"

namespace avoidbench {

/// A step of Kaplan and Meier's curve.
struct SurvivalPoint {
  double time_s = 0.0;    ///< when the events were
  double survival = 1.0;  ///< share without the event from this time on
  Interval interval;      ///< NaN where the survival is 0
  std::int64_t at_risk = 0, events = 0;
};

/// Kaplan and Meier's (1958) estimate of the share without an event (the goal reached, say) over
/// time, where some trials end without it (`is_event` false: they would have had it later, or
/// never). One step for each time with events, in order; a trial that ends without one at the same
/// time was still at risk. Intervals by Greenwood's variance on the log-log scale.
std::vector<SurvivalPoint> kaplan_meier(std::span<const double> times_s,
                                        const std::vector<bool>& is_event,
                                        double confidence = 0.95);

/// The first time by which `ratio` of the trials have had the event, by the curve (0.5: the median
/// time); +inf where it never comes that far.
double survival_quantile(std::span<const SurvivalPoint> points, double ratio);

}  // namespace avoidbench
