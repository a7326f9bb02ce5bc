#pragma once

#include "base/ticks.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// The rate that jerks are taken at, whatever that of the samples: rotors and controllers jerk the
/// vehicle at all time scales, so that finer differences only grow. The original records its
/// flights at this rate.
inline constexpr double kJerkRate_hz = 50.0;

/// Whether a flight is sampled at kJerkRate_hz too: where samples at least as frequent are not at
/// those moments.
inline bool adds_jerk_samples(const RatesSpec& rates) {
  const Tick jerk = required_period(kJerkRate_hz);
  const auto sample = period_ticks(rates.sample_hz);
  return sample && *sample < jerk && jerk % *sample != 0;
}

}  // namespace avoidbench
