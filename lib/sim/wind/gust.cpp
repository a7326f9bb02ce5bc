#include "wind/gust.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "base/random.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {

double gust_profile(const GustSpec& gust, double since_start_s) {
  const double length_s = 2.0 * gust.rise_s + gust.hold_s;
  if (!(since_start_s > 0.0 && since_start_s < length_s)) return 0.0;
  const double from_end_s = std::min(since_start_s, length_s - since_start_s);
  if (from_end_s >= gust.rise_s) return 1.0;
  // MIL-F-8785C, 3.7.1.3; the way down is the same, read backwards.
  return 0.5 * (1.0 - math::cos(math::kPi * from_end_s / gust.rise_s));
}

Eigen::Vector3d gust_velocity_world(const GustSpec& gust, std::uint64_t seed, double time_s) {
  Eigen::Vector3d velocity = to_eigen(gust.amplitude_world_mps);
  if (velocity.isZero(0.0) || !(time_s > gust.start_s)) return Eigen::Vector3d::Zero();
  double number = 0.0, start_s = gust.start_s;
  if (gust.period_s > 0.0) {
    // Which gust may blow at this time: check_wind() keeps them from overlapping.
    number = std::floor((time_s - gust.start_s) / gust.period_s);
    start_s += number * gust.period_s;
  }
  if (gust.start_jitter_s > 0.0 || gust.random_heading) {
    // A stream for each gust by its number: any time can be asked for, in any order.
    RandomStream random(stream_seed(seed, static_cast<std::uint64_t>(number)));
    // Both draws in any case and in this order, so that one of the two settings does not change the
    // other.
    start_s += gust.start_jitter_s * random.uniform();
    const double turn_rad = math::kTau * random.uniform();
    if (gust.random_heading) {
      const double c = math::cos(turn_rad), s = math::sin(turn_rad);
      velocity = {c * velocity.x() - s * velocity.y(), s * velocity.x() + c * velocity.y(),
                  velocity.z()};
    }
  }
  return gust_profile(gust, time_s - start_s) * velocity;
}

}  // namespace avoidbench
