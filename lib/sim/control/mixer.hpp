#pragma once

#include <Eigen/Core>

#include "vehicle/model.hpp"

namespace avoidbench {

/// The rotors' thrusts, each within zero to its greatest, that give this collective thrust and
/// torque about body x, y, z.
///
/// Exact where the rotors can give it, with the least sum of squares where there are more than
/// four. Otherwise roll and pitch come first, then collective thrust, then yaw: roll and pitch are
/// kept, or scaled down together if no collective thrust leaves room for them; collective thrust
/// moves by as little as makes room; yaw torque takes what is left.
RotorVector mix_thrusts(const VehicleModel& model, double thrust_n,
                        const Eigen::Vector3d& torque_body_nm);

/// The rotor speeds that give mix_thrusts(): what the motors are told.
RotorVector mix(const VehicleModel& model, double thrust_n, const Eigen::Vector3d& torque_body_nm);

}  // namespace avoidbench
