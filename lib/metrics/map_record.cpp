#include "metrics/map_record.hpp"

#include <limits>

#include "base/random.hpp"
#include "metrics/environment.hpp"
#include "metrics/reference_path.hpp"

namespace avoidbench {
namespace {

MissionRecord make_mission_record(const TrialSpec& spec, const Scene& scene, ClearanceGrid& grid,
                                  double radius_m, std::int64_t index) {
  MissionRecord mission;
  mission.index = index;
  mission.reference_length_m = std::numeric_limits<double>::quiet_NaN();
  const auto made = make_mission(scene, spec.mission, spec.seed, index);
  if (!made) {
    mission.is_valid = false;
    mission.invalid_reason = "no start or goal with enough free space around it";
    return mission;
  }
  mission.mission = *made;
  const auto path = reference_path(grid, *made, spec.mission.goal_radius_m, radius_m);
  if (!path) {
    mission.is_valid = false;
    mission.invalid_reason = "the goal can't be reached";
    return mission;
  }
  mission.reference_length_m = path_length_m(*path);
  mission.difficulty = mission_difficulty(
      scene, *path, radius_m,
      stream_seed(stream_seed(spec.seed, "difficulty"), static_cast<std::uint64_t>(index)));
  return mission;
}

}  // namespace

MapRecord make_map_record(const TrialSpec& spec, const Scene& scene, std::int64_t mission_count) {
  const World& world = scene.world();
  const BodyMeasure body = body_measure(to_eigen(spec.vehicle.body_size_m));
  ClearanceGrid grid(scene, world.bounds, kMapCell_m);
  const Traversability trav = traversability(scene, grid, body);
  MapRecord map{.key = {},
                .world_digest = world.digest,
                .obstacle_count = obstacle_count(world),
                .triangle_count = static_cast<std::int64_t>(triangle_count(world)),
                .traversability = trav.value,
                .traversability_normalized_ratio = trav.normalized_ratio,
                .relative_gap_size = relative_gap_size(world, body),
                .obstacle_density_1pm2 = obstacle_density_1pm2(world),
                .free_volume_ratio = free_volume_ratio(scene, grid, body),
                .missions = {}};
  for (std::int64_t index = 0; index < mission_count; ++index) {
    map.missions.push_back(make_mission_record(spec, scene, grid, body.radius_m, index));
  }
  return map;
}

}  // namespace avoidbench
