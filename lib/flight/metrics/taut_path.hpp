#pragma once

#include <optional>
#include <vector>

#include "metrics/clearance_grid.hpp"

namespace avoidbench {

/// Where a flight has reached its goal: horizontally within the radius, at any height.
struct GoalRegion {
  Eigen::Vector3d center_world = Eigen::Vector3d::Zero();
  double radius_m = 0.8;

  bool contains(const Eigen::Vector3d& point_world) const {
    return (center_world - point_world).head<2>().norm() <= radius_m;
  }
};

/// The point of the region nearest to `from`: at the same height.
Eigen::Vector3d nearest_of(const GoalRegion& goal, const Eigen::Vector3d& from);

/// Where the segment enters the region; nothing if it stays outside.
std::optional<Eigen::Vector3d> first_entry(const GoalRegion& goal, const Eigen::Vector3d& from,
                                           const Eigen::Vector3d& to);

/// Ends the path where it first enters the region.
void cut_at_goal(const GoalRegion& goal, std::vector<Eigen::Vector3d>& path);

/// Pulls a free path for a ball of `radius_m` taut against the surfaces, its end sliding on the
/// rim of the region: shorter with every round, until a round wins less than 0.01 %. Its first
/// point stays, its last alone is in the region, and all stay within the grid's region.
void pull_taut(ClearanceGrid& grid, double radius_m, const GoalRegion& goal,
               std::vector<Eigen::Vector3d>& path);

}  // namespace avoidbench
