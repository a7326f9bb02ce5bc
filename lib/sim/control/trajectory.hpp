#pragma once

#include <span>

#include "control/command.hpp"
#include "control/reference.hpp"

namespace avoidbench {

/// The trajectory `time_s` after its start: between two points the quintic with the positions,
/// velocities and accelerations of both (and the cubic with the yaws and yaw rates of both, the
/// shorter way round); its own third derivative is the jerk, so that the points' is not needed.
/// Before the first point the first, at and after the last the last, as they stand.
///
/// `piece` is where the search for the two points starts, and becomes where it ended: times mostly
/// rise.
Reference sample_trajectory(std::span<const TrajectoryPoint> points, double time_s,
                            std::size_t& piece);

}  // namespace avoidbench
