#include "vehicle/model.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/math.hpp"
#include "geometry/pose.hpp"
#include "vehicle/allocation.hpp"

namespace avoidbench {
namespace {

/// Following V(d) inwards decelerates by V V', greatest on the root part; each part meets the next
/// with equal slope.
BrakingCurve make_curve(double max_speed, double deceleration, double jerk, double max_gain) {
  BrakingCurve curve;
  // Slow vehicles never reach the full deceleration: lower it until the root part begins below the
  // ramp.
  const double by_jerk = std::sqrt(max_speed * jerk / 1.5);
  const double by_gain =
      jerk * (std::sqrt(1.0 / (max_gain * max_gain) + 2.0 * max_speed / jerk) - 1.0 / max_gain);
  const double a = std::min({deceleration, by_jerk, by_gain});
  curve.max_speed = max_speed;
  curve.deceleration = a;
  curve.jerk = jerk;
  // At the target the deceleration falls at gain times itself: within the jerk.
  curve.gain = std::min(jerk / a, max_gain);
  curve.root_from = a / (curve.gain * curve.gain);
  // Where the ramp begins: a full ramp of deceleration takes a²/2j off the speed.
  const double ramp_speed = max_speed - 0.5 * a * a / jerk;
  curve.ramp_from = 0.5 * ramp_speed * ramp_speed / a + 0.5 * curve.root_from;
  const double ramp_s = a / jerk;
  // From there the way of that ramp, jerk constant.
  curve.cap_from = curve.ramp_from + ramp_s * (max_speed - a * ramp_s / 6.0);
  return curve;
}

void set_rotors(VehicleModel& model) {
  const VehicleSpec& spec = model.spec;
  for (std::size_t i = 0; i < spec.rotors.size(); ++i) {
    const RotorSpec& rotor = spec.rotors[i];
    model.rotor_x_m[i] = rotor.position_body_m[0];
    model.rotor_y_m[i] = rotor.position_body_m[1];
    model.rotor_z_m[i] = rotor.position_body_m[2];
    model.spin[i] = static_cast<double>(rotor.spin);
    model.rolling_sign[i] = spec.rolling_moment_follows_spin ? model.spin[i] : 1.0;
  }
  const Eigen::Matrix4Xd allocation = allocation_matrix(spec);
  const auto mixing = pseudo_inverse(allocation);
  AB_CHECK(mixing.has_value());
  model.allocation.setZero();
  model.hover_speed_radps.resize(model.rotor_count);
  double speed_sum = 0.0;
  for (int i = 0; i < model.rotor_count; ++i) {
    model.allocation.col(i) = allocation.col(i);
    for (int j = 0; j < 4; ++j) {
      model.mixing[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = (*mixing)(i, j);
    }
    const double hover_n = (*mixing)(i, 0) * spec.mass_kg * spec.gravity_mps2;
    model.hover_speed_radps[i] = std::sqrt(hover_n / spec.thrust_coefficient_ns2);
    speed_sum += model.hover_speed_radps[i];
  }
  // At hover speeds, where drag over velocity is about constant.
  const double across = spec.rotor_drag_coefficient_kg * speed_sum;
  const double along = spec.rotor_axial_drag_coefficient_kg * speed_sum;
  model.drag_per_s = (to_eigen(spec.linear_drag_kgps) + Eigen::Vector3d(across, across, along)) *
                     model.inverse_mass;
}

}  // namespace

VehicleModel make_model(const VehicleSpec& vehicle) {
  check_vehicle(vehicle);
  VehicleModel model;
  model.spec = vehicle;
  model.rotor_count = static_cast<int>(vehicle.rotors.size());
  model.inertia_kgm2 = to_eigen(vehicle.inertia_kgm2);
  model.inverse_inertia = model.inertia_kgm2.cwiseInverse();
  model.inverse_mass = 1.0 / vehicle.mass_kg;
  model.max_rotor_thrust_n = vehicle.thrust_coefficient_ns2 * vehicle.max_rotor_speed_radps *
                             vehicle.max_rotor_speed_radps;
  set_rotors(model);

  // The reference leaves a fifth of the acceleration to corrections, and shares the jerk between
  // braking along the curve and closing in on it.
  constexpr double kBraking = 0.8, kBrakingJerk = 0.4, kClosingJerk = 0.5, kMaxGain = 4.0;
  model.speed_curve = make_curve(vehicle.max_speed_mps, kBraking * vehicle.max_acceleration_mps2,
                                 kBrakingJerk * vehicle.max_jerk_mps3, kMaxGain);
  // Faster than the curve that it follows.
  model.acceleration_gain = 1.8 * model.speed_curve.gain;
  model.acceleration_jerk = kClosingJerk * vehicle.max_jerk_mps3;
  const double yaw_braking = kBraking * vehicle.max_yaw_acceleration_radps2;
  model.yaw_curve =
      make_curve(vehicle.max_yaw_rate_radps, yaw_braking, kMaxGain * yaw_braking, kMaxGain);

  model.position_period = *period_ticks(vehicle.position_controller.rate_hz);
  model.rate_period = *period_ticks(vehicle.rate_controller.rate_hz);
  model.lee_period = *period_ticks(vehicle.lee_controller.rate_hz);
  // Made once for the usual period of physics, 1 ms; step() makes others as they come.
  model.lag_step_s = seconds(kTicksPerMillisecond);
  model.lag_up = math::exp(-0.5 * model.lag_step_s / vehicle.time_constant_up_s);
  model.lag_down = math::exp(-0.5 * model.lag_step_s / vehicle.time_constant_down_s);
  return model;
}

Eigen::Vector4d wrench(const VehicleModel& model, const RotorVector& thrust_n) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int i = 0; i < model.rotor_count; ++i) sum += model.allocation.col(i) * thrust_n[i];
  return sum;
}

}  // namespace avoidbench
