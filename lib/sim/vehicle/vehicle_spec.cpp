#include "vehicle/vehicle_spec.hpp"

#include <cmath>

#include "base/input_error.hpp"
#include "base/ticks.hpp"
#include "vehicle/allocation.hpp"
#include "vehicle/capability.hpp"

namespace avoidbench {

VehicleSpec hummingbird_spec() { return {}; }

VehicleSpec hummingbird_rotors_spec() {
  VehicleSpec vehicle;
  vehicle.name = "hummingbird_rotors";
  vehicle.gravity_mps2 = 9.8;
  vehicle.rolling_moment_follows_spin = false;
  vehicle.motor_reaction_torque = false;
  vehicle.lee_controller.mass_kg = 0.716;  // of rotors_gazebo/resource/hummingbird.yaml
  vehicle.lee_controller.gravity_mps2 = 9.81;
  vehicle.lee_controller.feed_forward = false;
  return vehicle;
}

/// Ascending Technologies' Firefly as in RotorS: six rotors at 60°, the first at 30° from x.
VehicleSpec firefly_spec() {
  constexpr double kArm = 0.215, kHeight = 0.036281567;
  const double cos30 = 0.5 * std::sqrt(3.0);
  const double x = cos30 * kArm, y = 0.5 * kArm;
  VehicleSpec vehicle;
  vehicle.name = "firefly";
  vehicle.mass_kg = 1.54503;
  vehicle.inertia_kgm2 = {0.03565798, 0.04679459, 0.09912675};
  vehicle.rotors = {{{x, y, kHeight}, 1},    {{0.0, kArm, kHeight}, -1}, {{-x, y, kHeight}, 1},
                    {{-x, -y, kHeight}, -1}, {{0.0, -kArm, kHeight}, 1}, {{x, -y, kHeight}, -1}};
  vehicle.max_acceleration_mps2 = 5.0;
  vehicle.max_jerk_mps3 = 20.0;
  vehicle.rate_controller.p_nms_per_rad = {0.92, 1.2, 2.0};
  vehicle.lee_controller.position_n_per_m = {6.0, 6.0, 6.0};
  vehicle.lee_controller.velocity_ns_per_m = {4.7, 4.7, 4.7};
  vehicle.lee_controller.attitude_nm_per_rad = {3.0, 3.0, 0.15};
  vehicle.lee_controller.rates_nms_per_rad = {0.52, 0.52, 0.18};
  vehicle.body_size_m = {0.63, 0.63, 0.16};
  return vehicle;
}

void check_vehicle(const VehicleSpec& vehicle) {
  std::vector<InputProblem> problems;
  const auto add = [&](const std::string& message) {
    InputProblem problem;
    problem.message = "vehicle " + vehicle.name + ": " + message;
    problems.push_back(std::move(problem));
  };
  const std::size_t count = vehicle.rotors.size();
  // Nothing else makes sense then.
  if (count == 0 || count > kMaxRotors) {
    add("rotors: " + std::to_string(count) + " of them, not one to eight");
    throw InputError(problems);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(vehicle.rotors[i].spin) != 1) {
      add("rotors[" + std::to_string(i) + "].spin: neither 1 nor -1");
    }
  }
  if (!(vehicle.mass_kg > 0.0)) add("mass_kg: not above zero");
  for (const double moment : vehicle.inertia_kgm2) {
    if (!(moment > 0.0)) add("inertia_kgm2: not above zero");
  }
  if (!(vehicle.time_constant_up_s > 0.0 && vehicle.time_constant_down_s > 0.0)) {
    add("time_constant_up_s, time_constant_down_s: not above zero");
  }
  for (const double rate_hz : {vehicle.position_controller.rate_hz, vehicle.rate_controller.rate_hz,
                               vehicle.lee_controller.rate_hz}) {
    if (!period_ticks(rate_hz)) {
      add("controller rate_hz: the period is not a whole number of ticks of 1/36000 s");
    }
  }
  // A rotor's thrust is k ω².
  const double max_thrust_n = vehicle.thrust_coefficient_ns2 * vehicle.max_rotor_speed_radps *
                              vehicle.max_rotor_speed_radps;
  const auto mixing = pseudo_inverse(allocation_matrix(vehicle));
  if (!mixing) {
    add("rotors: collective thrust and the three torques can't be set independently");
  } else {
    // Hover asks each rotor for a positive thrust; going sideways at the limit asks for this much
    // more.
    const double g = vehicle.gravity_mps2;
    const double a = vehicle.max_acceleration_mps2;
    bool hovers = true, accelerates = true;
    for (int i = 0; i < static_cast<int>(count); ++i) {
      // Column 0 is collective thrust: this rotor's part of the weight, divided by g.
      const double share = (*mixing)(i, 0) * vehicle.mass_kg;
      hovers = hovers && share > 0.0 && share * g < max_thrust_n;
      accelerates = accelerates && share * std::sqrt(g * g + a * a) < max_thrust_n;
    }
    if (!hovers)
      add("can't hover: a rotor would need a thrust outside zero to its greatest");
    else if (!accelerates)
      add("max_acceleration_mps2: the rotors are too weak for it while holding height");
  }
  if (problems.empty() && !is_settled(vehicle)) {
    add("thrust_to_weight, angular_acceleration_radps2: not what the other fields give");
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace avoidbench
