#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/scene.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// One flight's task.
struct Mission {
  Eigen::Vector3d start_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal_world = Eigen::Vector3d::Zero();
  double start_yaw_rad = 0.0;  ///< toward the first goal, if the sweep does not say otherwise
  std::vector<Eigen::Vector3d> waypoints_world = {};  ///< goals to reach in order before this one
};

/// All goals of a mission in order, the last one goal_world.
std::vector<Eigen::Vector3d> goals_of(const Mission& mission);

/// The mission with its start as one more goal.
Mission with_return(Mission mission);

/// Mission `index` of this map: start and goal drawn from the map's bands and way points from its
/// flight bounds, each with no surface within `spec.free_radius_m`. It depends on the map, the
/// mission's rules, `seed` and `index` alone, so that every planner flies the same missions.
/// Nothing when there is no such place.
std::optional<Mission> make_mission(const Scene& scene, const MissionSpec& spec, std::uint64_t seed,
                                    std::int64_t index);

/// Mission `index` of a trial's map: of `listed`, or made where that is empty. Nothing where there
/// is none.
std::optional<Mission> the_mission(const Scene& scene, const TrialSpec& trial, std::int64_t index,
                                   const std::vector<Mission>& listed);

/// The heading from start to goal.
double yaw_toward_goal_rad(const Eigen::Vector3d& start_world, const Eigen::Vector3d& goal_world);

}  // namespace avoidbench
