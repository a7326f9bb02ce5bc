#pragma once

#include "base/check.hpp"
#include "base/ticks.hpp"

namespace avoidbench {

/// The period of a rate that was rounded to whole ticks when it was read.
inline Tick required_period(double rate_hz) {
  const auto period = period_ticks(rate_hz);
  AB_CHECK(period.has_value(), rate_hz, "Hz is not a whole number of ticks");
  return *period;
}

}  // namespace avoidbench
