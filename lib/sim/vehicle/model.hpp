#pragma once

#include <Eigen/Core>
#include <array>

#include "vehicle/state.hpp"
#include "vehicle/vehicle_spec.hpp"

namespace avoidbench {

/// A speed that a distance allows, made so that following it inwards needs no more than a given
/// deceleration and jerk: proportional near the target, then the root of constant deceleration,
/// then a ramp of that deceleration up to the cap. See reference_governor.hpp.
struct BrakingCurve {
  double max_speed = 0.0, deceleration = 0.0, jerk = 0.0;
  double gain = 0.0;                                        ///< slope at the target, 1/s
  double root_from = 0.0, ramp_from = 0.0, cap_from = 0.0;  ///< distances where the parts begin
};

/// What is computed once from a VehicleSpec and then only read. Rotor arrays beyond rotor_count are
/// zero.
struct VehicleModel {
  VehicleSpec spec;
  int rotor_count = 0;
  std::array<double, kMaxRotors> rotor_x_m{}, rotor_y_m{}, rotor_z_m{};
  std::array<double, kMaxRotors> spin{};  ///< +1 counter-clockwise
  std::array<double, kMaxRotors>
      rolling_sign{};  ///< the spin, or 1 where the rolling moment ignores it
  Eigen::Vector3d inertia_kgm2, inverse_inertia;
  double inverse_mass = 0.0;
  double max_rotor_thrust_n = 0.0;

  /// Rotor thrusts to collective thrust and torque about body x, y, z; and its pseudo-inverse, the
  /// mixer's: the thrusts with the least sum of squares.
  Eigen::Matrix<double, 4, kMaxRotors> allocation;
  std::array<std::array<double, 4>, kMaxRotors> mixing{};

  RotorVector hover_speed_radps;
  /// Drag over mass and velocity at hover, body axes: what the controller compensates.
  Eigen::Vector3d drag_per_s;

  BrakingCurve speed_curve, yaw_curve;
  double acceleration_gain = 0.0, acceleration_jerk = 0.0;  ///< the governor's velocity loop

  Tick position_period = 0, rate_period = 0, lee_period = 0;  ///< of the controllers

  /// Rotor lag factors exp(-dt/2/τ) for the physics step in common use, 1 ms; others are computed.
  double lag_step_s = 0.0, lag_up = 0.0, lag_down = 0.0;
};

/// Calls check_vehicle first.
VehicleModel make_model(const VehicleSpec& vehicle);

/// Collective thrust (N) and torque about body x, y, z (N m) of these rotor thrusts (N).
Eigen::Vector4d wrench(const VehicleModel& model, const RotorVector& thrust_n);

}  // namespace avoidbench
