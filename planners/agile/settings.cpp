#include "settings.hpp"

#include <algorithm>

namespace agile {

Settings settings_from(const ab_setup& setup) {
  Settings settings = avoidbench::settings_from(kParameters, setup);
  const auto limit = [](double& value, double most) {
    if (most > 0.0) value = std::min(value, most);
  };
  limit(settings.max_speed_mps, setup.max_speed_mps);
  limit(settings.heading.rate_radps, setup.max_yaw_rate_radps);
  if (setup.max_acceleration_mps2 > 0.0) {
    settings.vehicle_acceleration_mps2 = setup.max_acceleration_mps2;
  }
  return settings;
}

}  // namespace agile
