#include "metrics/known_world.hpp"

#include <algorithm>
#include <memory>

#include "metrics/map_record.hpp"
#include "metrics/reference_path.hpp"

namespace avoidbench {

PlannerWorld known_world(const TrialSpec& spec, const Scene& scene, const Mission& mission) {
  PlannerWorld world;
  world.distance_m = [&scene](const Eigen::Vector3d& place_world) {
    return std::min(scene.nearest(place_world, ClearanceGrid::kFar_m).distance_m,
                    ClearanceGrid::kFar_m);
  };
  // Cells that one radius asked for serve the next, too.
  const auto grid = std::make_shared<ClearanceGrid>(scene, scene.world().bounds, kMapCell_m);
  // Through the middle of circles that have to be passed, or waited in: who follows the path along
  // the edge of one may miss it.
  const double reach_m = spec.mission.goal_radius_m, inner_m = 0.5 * reach_m;
  const bool moves = spec.mission.goal_motion.path != GoalPath::none;
  world.shortest_path_world = [grid, mission, last_m = moves ? inner_m : reach_m,
                               inner_m](double radius_m) {
    return reference_path(*grid, mission, last_m, radius_m, inner_m)
        .value_or(std::vector<Eigen::Vector3d>{});
  };
  return world;
}

}  // namespace avoidbench
