#pragma once

#include <Eigen/Core>

#include "control/reference.hpp"
#include "vehicle/model.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// The torque about body x, y, z (N m) that the low-level controller of rpg_rotors_interface asks
/// for,
///
///     τ = P (ω_cmd - ω) + D (ω_cmd × J ω_cmd - τ_est) + ω × J ω,
///
/// τ_est being the torque of the rotors at their present speeds.
Eigen::Vector3d rate_torque(const VehicleModel& model, const VehicleState& state,
                            const RateTarget& target);

/// The rotor speeds to command for these body rates and collective thrust: rate_torque() through
/// the mixer (mixer.hpp). There the mixer clamps each rotor by itself, so that a hard yaw command
/// lifts the vehicle; ours gives up yaw first.
RotorVector rate_control(const VehicleModel& model, const VehicleState& state,
                         const RateTarget& target);

}  // namespace avoidbench
