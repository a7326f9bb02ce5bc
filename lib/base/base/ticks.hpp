#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "base/check.hpp"

namespace avoidbench {

/// Simulated time in whole ticks of 1/36,000 s, so that 1 kHz physics, 30, 50, 60, 90 and 200 Hz
/// sensors and whole milliseconds of latency are all exact and times never drift.
using Tick = std::int64_t;
inline constexpr Tick kTicksPerSecond = 36000;
inline constexpr Tick kTicksPerMillisecond = kTicksPerSecond / 1000;

inline constexpr double seconds(Tick tick) {
  return static_cast<double>(tick) / static_cast<double>(kTicksPerSecond);
}

/// The period of `rate_hz` in ticks, or nothing where it is not a whole number of ticks.
inline std::optional<Tick> period_ticks(double rate_hz) {
  if (!(rate_hz > 0.0)) return std::nullopt;
  const double exact = static_cast<double>(kTicksPerSecond) / rate_hz;
  const double whole = std::round(exact);
  if (whole < 1.0 || std::abs(exact - whole) > 1e-9 * exact) return std::nullopt;
  return static_cast<Tick>(whole);
}

/// The period of a rate that was rounded to whole ticks when it was read.
inline Tick required_period(double rate_hz) {
  const auto period = period_ticks(rate_hz);
  AB_CHECK(period.has_value(), rate_hz, "Hz is not a whole number of ticks");
  return *period;
}

/// `duration_s` rounded to the nearest tick.
inline Tick ticks(double duration_s) {
  return static_cast<Tick>(std::llround(duration_s * static_cast<double>(kTicksPerSecond)));
}

}  // namespace avoidbench
