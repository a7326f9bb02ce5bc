#pragma once

#include <Eigen/Core>

namespace avoidbench {

/// What acts on the vehicle from outside: the air's velocity, which the rotors and the body feel
/// through drag; a force at the centre of gravity; and a torque, in the body frame as Euler's
/// equations are.
struct Environment {
  Eigen::Vector3d wind_world_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_world_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_body_nm = Eigen::Vector3d::Zero();
};

}  // namespace avoidbench
