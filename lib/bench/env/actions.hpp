#pragma once

#include <span>
#include <vector>

#include "env/env_spec.hpp"
#include "plugin/planner_instance.hpp"
#include "vehicle/vehicle_spec.hpp"

/// A learner's numbers as the commands that planners give. One action is, in SI units:
///
///   velocity      vx, vy, vz, yaw rate
///   acceleration  ax, ay, az, yaw rate
///   rates_thrust  rates about body x, y, z; collective thrust over mass (g hovers)
///   trajectory    for each point x, y, z and yaw, from where the vehicle is and looks now; the
///                 points' times after the observation are horizon/points, 2 · horizon/points, …
///
/// Trajectories are cubic splines through the points, with the present velocity at their beginning
/// and no acceleration at their end. They are flown by their own time: the command begins where the
/// spline is when it takes effect.
namespace avoidbench {

/// Numbers in one action.
std::size_t action_width(const ActionSpec& action);

/// The least and greatest value of each number that means something for this vehicle. Others are
/// flown as a planner's are: its controller keeps its limits.
struct ActionLimits {
  std::vector<double> lowest, highest;
};
ActionLimits action_limits(const ActionSpec& action, const VehicleSpec& vehicle);

/// What is wrong with the numbers of an action, "" for nothing: one that is not finite or beyond
/// what any command may hold.
std::string action_problem(const ActionSpec& spec, std::span<const double> action);

/// The command that `action` means to who sees `view`; it takes effect `latency_s` later.
/// action_problem() must be empty. Times that are measured of planners are NaN.
PlanResult plan_result(const ActionSpec& spec, std::span<const double> action,
                       const PlannerView& view, double latency_s);

/// From level axes, x where the nose of a body with this attitude points, to world axes.
Eigen::Matrix3d rotation_world_heading(const Eigen::Quaterniond& q_world_body);

}  // namespace avoidbench
