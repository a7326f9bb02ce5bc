#pragma once

#include <Eigen/Geometry>

#include "base/ticks.hpp"
#include "geometry/pose.hpp"
#include "vehicle/vehicle_spec.hpp"

namespace avoidbench {

/// One number a rotor, in the spec's order; up to eight, never on the heap.
using RotorVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRotors, 1>;

/// What the vehicle does now. The position is the centre of gravity's; rotor speeds are magnitudes,
/// rad/s.
struct VehicleState {
  Tick tick = 0;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d rates_body = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_world_body = Eigen::Quaterniond::Identity();
  RotorVector rotor_speed_radps;
};

/// Body to world.
inline Pose pose_of(const VehicleState& state) {
  return make_pose(state.position_world, state.q_world_body);
}

/// At rest, level, at tick 0, with the rotors turning as they must to hover in still air.
VehicleState hovering_at(const VehicleSpec& vehicle, const Eigen::Vector3d& position_world,
                         double yaw_rad);

}  // namespace avoidbench
