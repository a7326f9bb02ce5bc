#pragma once

#include <Eigen/Core>
#include <vector>

#include "planning/polynomial.hpp"

namespace mbplanner {

using planning::Motion;

/// Between two knots of a path. On this step accelerations change linearly, so that the quintics
/// through the knots are the path itself.
inline constexpr double kStep_s = 0.05;

struct Limits {
  double speed_mps = 3.0;
  double acceleration_mps2 = 4.0;
  double jerk_mps3 = 20.0;
};

/// One step on, pulled by this acceleration: it is reached as fast as the jerk allows, and what
/// would lead beyond the speed is taken from it.
Motion stepped(const Motion& from, const Eigen::Vector3d& pull, const Limits& limits);

/// Knots after `from`, one a step.
std::vector<Motion> rolled_out(const Motion& from, const Eigen::Vector3d& pull,
                               const Limits& limits, int steps);

/// Knots after `from` to rest: against the velocity with this deceleration, then a quintic that
/// ends it. Braked again on the way it goes on as before.
std::vector<Motion> stop_from(const Motion& from, double braking_mps2, const Limits& limits);

/// Knots after `from` to rest at `place`, as fast as the limits allow; empty where no duration up
/// to four times the least keeps them.
std::vector<Motion> stop_at(const Motion& from, const Eigen::Vector3d& place, const Limits& limits);

}  // namespace mbplanner
