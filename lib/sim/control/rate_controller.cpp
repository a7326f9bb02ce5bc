#include "control/rate_controller.hpp"

#include "control/mixer.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {

Eigen::Vector3d rate_torque(const VehicleModel& model, const VehicleState& state,
                            const RateTarget& target) {
  using Eigen::Vector3d;
  const RateControllerSpec& gains = model.spec.rate_controller;
  // By the rotors' present speeds: as the low-level controller estimates torque, without knowing
  // the lag.
  RotorVector thrust_n(model.rotor_count);
  for (int i = 0; i < model.rotor_count; ++i) {
    const double speed = state.rotor_speed_radps[i];
    thrust_n[i] = model.spec.thrust_coefficient_ns2 * speed * speed;
  }
  const Vector3d torque_now = wrench(model, thrust_n).tail<3>();
  const Vector3d& inertia = model.inertia_kgm2;
  const Vector3d& wanted = target.rates_body_radps;
  const Vector3d& rates = state.rates_body;
  // The torque that keeps up the wanted rates.
  const Vector3d steady = wanted.cross(inertia.cwiseProduct(wanted));
  return to_eigen(gains.p_nms_per_rad).cwiseProduct(wanted - rates) +
         to_eigen(gains.d_ratio).cwiseProduct(steady - torque_now) +
         rates.cross(inertia.cwiseProduct(rates));
}

RotorVector rate_control(const VehicleModel& model, const VehicleState& state,
                         const RateTarget& target) {
  return mix(model, target.thrust_mps2 * model.spec.mass_kg, rate_torque(model, state, target));
}

}  // namespace avoidbench
