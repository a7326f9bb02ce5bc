#include "planning/heading.hpp"

#include <algorithm>
#include <cmath>

#include "avoidbench/portable_math.hpp"

namespace planning {
namespace {

constexpr double kClosing_per_s = 8.0;  ///< of the last part, where the rate falls with the error

}  // namespace

Heading turned(const Heading& now, double wanted_rad, const HeadingLimits& limits, double dt_s) {
  namespace portable = avoidbench::portable;
  const double error = portable::wrapped_angle(wanted_rad - now.yaw_rad);
  // The rate from which half the acceleration stops in time; near the end in proportion.
  const double size = std::abs(error);
  const double stopping = std::sqrt(limits.acceleration_radps2 * size);
  const double wanted_rate =
      std::copysign(std::min({limits.rate_radps, stopping, kClosing_per_s * size}), error);
  const double most = limits.acceleration_radps2 * dt_s;
  const double rate = now.rate_radps + std::clamp(wanted_rate - now.rate_radps, -most, most);
  return {now.yaw_rad + 0.5 * dt_s * (now.rate_radps + rate), rate};
}

}  // namespace planning
