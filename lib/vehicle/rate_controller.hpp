#pragma once

#include <Eigen/Core>

#include "vehicle/model.hpp"
#include "vehicle/reference.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// The rotor speeds to command for these body rates and collective thrust: the low-level controller
/// of rpg_rotors_interface,
///
///     τ = P (ω_cmd - ω) + D (ω_cmd × J ω_cmd - τ_est) + ω × J ω,
///
/// τ_est being the torque of the rotors at their present speeds, and then the mixer (mixer.hpp).
RotorVector rate_control(const VehicleModel& model, const VehicleState& state,
                         const RateTarget& target);

}  // namespace avoidbench
