#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <variant>
#include <vector>

namespace avoidbench {

/// Back and forth: amplitude · sin(2π(t/period + phase)) away.
struct Sway {
  Eigen::Vector3d amplitude_world = Eigen::Vector3d::Zero();  ///< [m]
  double period_s = 1.0;
  double phase = 0.0;  ///< in periods
};

/// A moment of a route.
struct Knot {
  double time_s = 0.0;
  Eigen::Vector3d offset_world = Eigen::Vector3d::Zero();  ///< [m]
  double turn_rad = 0.0;                                   ///< about the upright axis
};

/// From knot to knot straight on and turning evenly; before the first and after the last it stands.
struct Route {
  std::vector<Knot> knots;  ///< at least one, times rising
};

/// A trefoil knot around the instance's place: with a = 2π(t/period + phase), it is
/// reach/3 · (sin a + 2 sin 2a, cos a − 2 cos 2a), turned by heading, and rise · sin 3a above it.
struct Trefoil {
  double reach_m = 1.0;
  double rise_m = 0.0;
  double period_s = 1.0;
  double phase = 0.0;  ///< in periods
  double heading_rad = 0.0;
};

/// An instance that moves, as a function of time alone: away from its transform and turned about
/// the upright axis through its own origin.
struct Motion {
  std::uint32_t instance = 0;  ///< index into World::instances
  std::variant<Sway, Route, Trefoil> path;
};

/// How an instance stands beside its transform at a moment, and how fast it goes.
struct MotionState {
  Eigen::Vector3d offset_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  double turn_rad = 0.0;
};

MotionState state_at(const Motion& motion, double time_s);
inline Eigen::Vector3d displacement_world(const Motion& motion, double time_s) {
  return state_at(motion, time_s).offset_world;
}

double greatest_speed_mps(const Motion& motion);   ///< of the instance's origin
double greatest_turn_radps(const Motion& motion);  ///< about it

/// A rotation about the upright axis.
Eigen::Matrix3f upright_turn(double yaw_rad);

/// The transform of an instance that stands at `T_world_prototype` where `motion` has it.
Eigen::Affine3f moved(const Eigen::Affine3f& T_world_prototype, const Motion& motion,
                      double time_s);

}  // namespace avoidbench
