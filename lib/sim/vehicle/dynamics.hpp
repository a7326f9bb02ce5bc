#pragma once

#include <Eigen/Core>

#include "vehicle/model.hpp"
#include "vehicle/state.hpp"
#include "wind/environment.hpp"

namespace avoidbench {

/// The state one step later, under constant rotor commands and environment.
///
/// Equations and coefficients are those of RotorS (gazebo_motor_model.cpp) on one rigid body: per
/// rotor thrust k_f Ω², drag and rolling moment linear in Ω times the hub's air speed across the
/// axis, drag torque k_m times thrust; the rotors' spin as a gyroscopic torque; optionally their
/// reaction torque and drag of the body. Rotor speeds lag behind the commands, limited to zero to
/// the greatest speed, to first order with the up or the down time constant, solved exactly for any
/// length of step. The body's motion is integrated by classic RK4 with these speeds at
/// the stages, so of fourth order whichever way each rotor goes; the quaternion is normalised after
/// each step.
VehicleState step(const VehicleModel& model, const VehicleState& state,
                  const RotorVector& command_radps, const Environment& environment, Tick dt_ticks);

/// The same over any time; the tick stays.
VehicleState step_by(const VehicleModel& model, const VehicleState& state,
                     const RotorVector& command_radps, const Environment& environment, double dt_s);

/// Acceleration of the centre of gravity, gravity included: zero in hover, (0, 0, -g) in free fall.
Eigen::Vector3d acceleration_world(const VehicleModel& model, const VehicleState& state,
                                   const Environment& environment);

/// Angular acceleration, body frame, rad/s², were the rotors' speeds constant.
Eigen::Vector3d angular_acceleration_body(const VehicleModel& model, const VehicleState& state,
                                          const Environment& environment);

/// Mechanical power into the rotors' drag: the sum of drag torque times speed.
double rotor_power_w(const VehicleModel& model, const VehicleState& state);

}  // namespace avoidbench
