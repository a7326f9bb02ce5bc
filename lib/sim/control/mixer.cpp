#include "control/mixer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace avoidbench {
namespace {

using Rotors = std::array<double, kMaxRotors>;

/// The greatest part in [0, 1] of `tilt` for which some collective thrust keeps every rotor within
/// its limits.
double tilt_that_fits(const VehicleModel& model, const Rotors& tilt) {
  const double highest = model.max_rotor_thrust_n;
  double part = 1.0;
  // Each pair of rotors limits it: one that tilts down has to stay above 0 while the other, tilting
  // up, stays below its greatest. Eight rotors have 64 pairs.
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.rotor_count); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(model.rotor_count); ++j) {
      // Rotor i may not stop before rotor j is at its greatest: -s tᵢ/aᵢ <= (highest - s tⱼ)/aⱼ.
      const double spread = tilt[j] / model.mixing[j][0] - tilt[i] / model.mixing[i][0];
      const double room = highest / model.mixing[j][0];
      if (part * spread > room) part = room / spread;
    }
  }
  return part;
}

/// Each rotor's thrust within its limits, where not all that is asked for fits.
RotorVector saturated(const VehicleModel& model, double thrust_n, const Rotors& tilt,
                      const Rotors& yaw) {
  const double highest = model.max_rotor_thrust_n;
  // In this order, as autopilots do: roll and pitch keep the vehicle upright and come first, then
  // collective thrust, then yaw, which takes what is left.
  const double part = tilt_that_fits(model, tilt);
  // The collective thrusts at which this much tilt fits.
  double least_n = 0.0, greatest_n = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.rotor_count); ++i) {
    least_n = std::max(least_n, -part * tilt[i] / model.mixing[i][0]);
    greatest_n = std::min(greatest_n, (highest - part * tilt[i]) / model.mixing[i][0]);
  }
  // Thrust moves to where the tilt fits before the tilt gives way.
  const double collective_n = std::min(std::max(thrust_n, least_n), greatest_n);
  double yaw_part = 1.0;
  Rotors base{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.rotor_count); ++i) {
    base[i] = std::clamp(model.mixing[i][0] * collective_n + part * tilt[i], 0.0, highest);
    // Smaller from rotor to rotor, as each needs.
    if (base[i] + yaw_part * yaw[i] > highest) yaw_part = (highest - base[i]) / yaw[i];
    if (base[i] + yaw_part * yaw[i] < 0.0) yaw_part = -base[i] / yaw[i];
  }
  RotorVector thrusts(model.rotor_count);
  for (int i = 0; i < model.rotor_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    thrusts[i] = std::clamp(base[k] + yaw_part * yaw[k], 0.0, highest);
  }
  return thrusts;
}

}  // namespace

RotorVector mix_thrusts(const VehicleModel& model, double thrust_n,
                        const Eigen::Vector3d& torque_body_nm) {
  RotorVector thrusts(model.rotor_count);
  Rotors tilt{}, yaw{};
  // Most of the time all fits, and nothing has to be weighed.
  bool fits = true;
  for (int i = 0; i < model.rotor_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto& row = model.mixing[k];
    tilt[k] = row[1] * torque_body_nm.x() + row[2] * torque_body_nm.y();
    yaw[k] = row[3] * torque_body_nm.z();
    thrusts[i] = row[0] * thrust_n + tilt[k] + yaw[k];
    fits = fits && thrusts[i] >= 0.0 && thrusts[i] <= model.max_rotor_thrust_n;
  }
  return fits ? thrusts : saturated(model, thrust_n, tilt, yaw);
}

RotorVector mix(const VehicleModel& model, double thrust_n, const Eigen::Vector3d& torque_body_nm) {
  RotorVector values = mix_thrusts(model, thrust_n, torque_body_nm);
  for (int i = 0; i < model.rotor_count; ++i) {
    // Thrust is k_f Ω².
    values[i] = std::sqrt(values[i] / model.spec.thrust_coefficient_ns2);
  }
  return values;
}

}  // namespace avoidbench
