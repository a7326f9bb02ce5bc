#include "settings.hpp"

#include <algorithm>

#include "avoidbench/planner_eigen.hpp"

namespace ego {

Settings settings_from(const ab_setup& setup) {
  Settings settings = avoidbench::settings_from(kParameters, setup);
  settings.max_speed_mps = std::min(settings.max_speed_mps, setup.max_speed_mps);
  settings.vehicle_acceleration_mps2 = setup.max_acceleration_mps2;
  settings.max_acceleration_mps2 =
      std::min(settings.max_acceleration_mps2, 0.8 * setup.max_acceleration_mps2);
  settings.body_size_m = avoidbench::as_vector(setup.body_size_m);
  if (setup.gravity_mps2 > 0.0) settings.gravity_mps2 = setup.gravity_mps2;
  settings.heading = {0.8 * setup.max_yaw_rate_radps, 6.0};
  return settings;
}

}  // namespace ego
