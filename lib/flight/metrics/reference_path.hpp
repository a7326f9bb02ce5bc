#pragma once

#include <optional>
#include <vector>

#include "metrics/clearance_grid.hpp"
#include "trial/mission.hpp"

namespace avoidbench {

/// The shortest collision-free path for a ball of `radius_m` from a start to a goal's region, as a
/// polyline from the start to where it first comes within `goal_radius_m` of the goal,
/// horizontally; nothing where the goal can't be reached on the grid. It stays in the grid's
/// region: the world's bounds, that a flight's centre may not leave either.
///
/// Lazy Theta* (Nash, Koenig and Tovey 2010) over the grid's cells with exact lines of sight, led
/// by the distances of ColumnDistances raised by a hundredth, then the path is pulled taut against
/// the surfaces themselves. Deterministic. An independent search finds none that is 0.5 % shorter
/// (see the tests).
///
/// The ball is the largest in the body's horizontal outline: upright and whichever way it is
/// turned, the body needs that width. But it is flatter than the ball, so that it can pass a slot
/// of less than 0.5 m height that the reference goes around; such a flight shows a negative path
/// optimality, which is reported as it is.
std::optional<std::vector<Eigen::Vector3d>> leg_path(ClearanceGrid& grid,
                                                     const Eigen::Vector3d& start_world,
                                                     const Eigen::Vector3d& goal_world,
                                                     double goal_radius_m, double radius_m);

/// Such a path to each goal in order, each beginning where the one before it ends; as many as goals
/// can be reached. The last goal counts where it is at the start. The sum of their lengths is d_min
/// of the metrics. `between_radius_m`: of the goals before the last; left out: as the last one's.
std::vector<std::vector<Eigen::Vector3d>> reference_legs(
    ClearanceGrid& grid, const Mission& mission, double goal_radius_m, double radius_m,
    std::optional<double> between_radius_m = std::nullopt);

/// The legs as one polyline; nothing where a goal can't be reached.
std::optional<std::vector<Eigen::Vector3d>> reference_path(
    ClearanceGrid& grid, const Mission& mission, double goal_radius_m, double radius_m,
    std::optional<double> between_radius_m = std::nullopt);

/// Of legs that follow each other.
std::vector<Eigen::Vector3d> joined(const std::vector<std::vector<Eigen::Vector3d>>& legs);

double path_length_m(const std::vector<Eigen::Vector3d>& path);

}  // namespace avoidbench
