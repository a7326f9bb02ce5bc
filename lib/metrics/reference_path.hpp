#pragma once

#include <optional>
#include <vector>

#include "metrics/clearance_grid.hpp"
#include "trial/mission.hpp"

namespace avoidbench {

/// The shortest collision-free path for a ball of `radius_m` from the mission's start to its goal
/// region, as a polyline from the start to a point within `goal_radius_m` of the goal,
/// horizontally; nothing where the goal can't be reached on the grid. Its length is d_min of the
/// metrics.
///
/// Lazy Theta* (Nash, Koenig and Tovey 2010) over the grid's cells with exact lines of sight, then
/// the path is pulled taut against the surfaces themselves. Deterministic. The ball is the largest
/// in the body's horizontal outline, so that a flight that turns its body can't pass where the
/// reference could not; what a flight can still win, by a body flatter than the ball and by arcs
/// cut into corners, stays below 1 % (see the tests).
std::optional<std::vector<Eigen::Vector3d>> reference_path(ClearanceGrid& grid,
                                                           const Mission& mission,
                                                           double goal_radius_m, double radius_m);

double path_length_m(const std::vector<Eigen::Vector3d>& path);

}  // namespace avoidbench
