#pragma once

#include <Eigen/Core>

#include "control/reference.hpp"
#include "vehicle/model.hpp"

namespace avoidbench {

/// What the governor steers its reference to.
enum class GovernorGoal { position, velocity, acceleration };

struct GovernorTarget {
  GovernorGoal goal = GovernorGoal::velocity;
  Eigen::Vector3d value_world = Eigen::Vector3d::Zero();  ///< m, m/s or m/s², as the goal says
  bool yaw_is_rate = true;
  double yaw = 0.0;  ///< rad, or rad/s where yaw_is_rate
};

struct Speed {
  double value = 0.0;
  double slope = 0.0;  ///< over distance, 1/s
};

/// The speed that `curve` allows at this distance (>= 0) from the target.
Speed allowed_speed(const BrakingCurve& curve, double distance);

/// The reference `dt_s` later, on its way to the target within the vehicle's speed, acceleration
/// and jerk (Euclidean norms) and its yaw rate and acceleration.
///
/// A position target asks for the velocity that a braking curve allows at that distance, towards
/// the target; closing in on a wanted velocity happens along a root law whose acceleration vanishes
/// as fast as the jerk lets it, on top of the wanted velocity's own change. So the reference brakes
/// in time, comes to rest at the target without overshoot (if it could from where it was) and stays
/// there. An acceleration target is held until the speed limit. No state but the reference, no
/// direction preferred: turning the world turns the result.
Reference governed(const VehicleModel& model, const Reference& reference,
                   const GovernorTarget& target, double dt_s);

/// The way that a reference at this speed (m/s) takes to rest where the target is a velocity of
/// zero, in closed form: the jerk limit up to the acceleration limit a, then a, then down by the
/// law that closes in on a velocity, half the jerk and at last in proportion. More than v² / 2a by
/// what the jerk costs.
double stopping_distance_m(const VehicleModel& model, double speed_mps);

}  // namespace avoidbench
