#pragma once

namespace planning {

/// Yaw and its rate; the yaw may count on over whole turns.
struct Heading {
  double yaw_rad = 0.0, rate_radps = 0.0;
};

struct HeadingLimits {
  double rate_radps = 2.0, acceleration_radps2 = 6.0;
};

/// The heading `dt_s` later of one that turns to `wanted_rad` the shorter way round: as fast as the
/// limits allow, slowing down in time to stop there.
Heading turned(const Heading& now, double wanted_rad, const HeadingLimits& limits, double dt_s);

}  // namespace planning
