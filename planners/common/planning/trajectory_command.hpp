#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "avoidbench/planner.h"
#include "planning/heading.hpp"
#include "planning/polynomial.hpp"

namespace planning {

/// A motion with a beginning and an end, by its own time.
struct TimedMotion {
  std::function<Motion(double time_s)> at;  ///< from 0 to the duration
  double duration_s = 0.0;
};

/// From this motion to rest along its velocity, a quintic that brakes with at most
/// `braking_mps2` (and what it needs to undo the motion's own acceleration).
Quintic stopping(const Motion& from, double braking_mps2);

/// The motion, and from its end on to rest by stopping().
TimedMotion with_stop(const TimedMotion& motion, double braking_mps2);

/// Where to look while flying: yaw of the way to the point `look_ahead_s` later, kept where that is
/// nearer than `least_way_m` (EGO-Planner's law).
struct LookAhead {
  double look_ahead_s = 1.0, least_way_m = 0.1;
  HeadingLimits limits;
};

/// What is left of a motion at `from_s`, as the points of a trajectory command, one each `step_s`
/// and at least two. The motion should end at rest. Headings begin with `heading`, the first
/// point's. `facing`, where given, is the yaw to turn to, whatever the way.
std::vector<ab_point> trajectory_points(const TimedMotion& motion, double from_s, double step_s,
                                        const Heading& heading, const LookAhead& look,
                                        std::optional<double> facing = std::nullopt);

/// The greatest rate at which a motion turns the thrust of a multirotor, which points along
/// acceleration less gravity: roll and pitch it needs. From `count` samples of the motion.
double thrust_turn_rate_radps(const TimedMotion& motion, double gravity_mps2, int count = 60);

/// The heading of such points `time_s` after the first.
Heading heading_at(const std::vector<ab_point>& points, double time_s);

}  // namespace planning
