#pragma once

#include <Eigen/Core>
#include <optional>

#include "vehicle/vehicle_spec.hpp"

namespace avoidbench {

/// Rotor thrusts (N) to collective thrust (N) and torque about body x, y, z (N m): 4 × rotor count.
/// A rotor that turns counter-clockwise drags the body clockwise.
Eigen::Matrix4Xd allocation_matrix(const VehicleSpec& vehicle);

/// The pseudo-inverse Aᵀ(AAᵀ)⁻¹ (the inverse, for four rotors), rotor count × 4, or nothing where
/// A's rank is below 4.
std::optional<Eigen::MatrixX4d> pseudo_inverse(const Eigen::Matrix4Xd& allocation);

}  // namespace avoidbench
