#include "wind/kicks.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

Eigen::Vector3d any_direction(RandomStream& random) {
  const double z = random.uniform(-1.0, 1.0);
  const double angle_rad = math::kTau * random.uniform();
  // Archimedes: a uniform height and a uniform angle are uniform on the sphere.
  const double across = std::sqrt(1.0 - z * z);
  return {across * math::cos(angle_rad), across * math::sin(angle_rad), z};
}

}  // namespace

std::vector<Kick> make_kicks(const KickSpec& kicks, std::uint64_t seed, double until_s) {
  std::vector<Kick> made;
  if (!(kicks.rate_per_min > 0.0) || (kicks.force_n == 0.0 && kicks.torque_nm == 0.0)) return made;
  const double mean_gap_s = 60.0 / kicks.rate_per_min;
  // A kick shorter than a tick would have no impulse at all.
  const Tick duration = std::max<Tick>(1, ticks(kicks.duration_s));
  RandomStream random(seed);
  double time_s = 0.0;
  // A Poisson process: gaps are exponential.
  while (true) {
    // 1 - u is never 0.
    time_s -= mean_gap_s * math::log(1.0 - random.uniform());
    if (time_s >= until_s) return made;
    Kick kick;
    kick.from = ticks(time_s);
    kick.until = kick.from + duration;
    kick.force_world_n = kicks.force_n * any_direction(random);
    kick.torque_body_nm = kicks.torque_nm * any_direction(random);
    made.push_back(kick);
  }
}

}  // namespace avoidbench
