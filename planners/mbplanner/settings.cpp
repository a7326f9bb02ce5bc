#include "settings.hpp"

#include <algorithm>

namespace mbplanner {
namespace {

/// `limit` where the vehicle has one.
double capped(double value, double limit) { return limit > 0.0 ? std::min(value, limit) : value; }

}  // namespace

Settings settings_from(const ab_setup& setup) {
  Settings s = avoidbench::settings_from(kParameters, setup);
  const double pull_mps2 =
      setup.max_acceleration_mps2 > 0.0 ? 0.95 * setup.max_acceleration_mps2 : 20.0;
  s.speed_mps = capped(s.speed_mps, setup.max_speed_mps);
  s.climb_mps2 = std::min(s.climb_mps2, 0.3 * pull_mps2);
  s.acceleration_mps2 = std::min(s.acceleration_mps2, 0.9 * pull_mps2);
  s.braking_mps2 = std::min(s.braking_mps2, 0.9 * pull_mps2);
  s.greatest_acceleration_mps2 = pull_mps2;
  s.body_length_m = std::max({setup.body_size_m[0], setup.body_size_m[1], 0.1});
  s.body_height_m = std::max(setup.body_size_m[2], 0.05);
  s.yaw_rate_radps = capped(s.yaw_rate_radps, 0.95 * setup.max_yaw_rate_radps);
  for (std::uint32_t i = 0; i < setup.camera_count; ++i) {
    const double focal_px = setup.cameras[i]->fx_px;
    s.focal_length_px = i == 0 ? focal_px : std::min(s.focal_length_px, focal_px);
  }
  return s;
}

}  // namespace mbplanner
