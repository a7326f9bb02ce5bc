#include "config/vehicle_facts.hpp"

#include <algorithm>

#include "control/reference_governor.hpp"
#include "text/number_text.hpp"
#include "vehicle/capability.hpp"

namespace avoidbench {
namespace {

/// "295/292/49": roll, pitch, yaw.
std::string per_axis(const std::array<double, 3>& values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : "/") + fixed_digits(value, value < 10.0 ? 1 : 0);
  }
  return text;
}

}  // namespace

Explanation built_in_vehicles() {
  Explanation about;
  about.title =
      "Vehicles that are built in: thrust/weight; roll, pitch and yaw acceleration from hover, "
      "rad/s²; rotor speed in hover, rad/s; speed that drag allows, m/s; limits of the reference: "
      "speed, m/s, acceleration, m/s², and the way from that speed to rest, m";
  about.columns = {"name",    "thrust/weight", "turning",      "hover",
                   "by_drag", "max_speed",     "acceleration", "stops_in"};
  for (const VehicleSpec& vehicle : vehicle_presets()) {
    const VehicleModel model = make_model(vehicle);
    about.keys.push_back({vehicle.name, fixed_digits(thrust_to_weight(vehicle), 2),
                          per_axis(hover_angular_acceleration_radps2(vehicle)),
                          fixed_digits(hover_rotor_speed_radps(vehicle), 0),
                          fixed_digits(top_speed_mps(vehicle), 0),
                          significant_digits(vehicle.max_speed_mps, 3),
                          significant_digits(vehicle.max_acceleration_mps2, 3),
                          fixed_digits(stopping_distance_m(model, vehicle.max_speed_mps), 1)});
  }
  return about;
}

}  // namespace avoidbench
