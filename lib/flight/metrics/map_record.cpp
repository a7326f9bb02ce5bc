#include "metrics/map_record.hpp"

#include <limits>

#include "base/math.hpp"
#include "base/number_text.hpp"
#include "base/random.hpp"
#include "metrics/environment.hpp"
#include "metrics/reference_path.hpp"

namespace avoidbench {
namespace {

std::string place_text(const Eigen::Vector3d& place) {
  return "(" + shortest(place.x()) + ", " + shortest(place.y()) + ", " + shortest(place.z()) + ")";
}

/// What is wrong with a start or goal, or "".
std::string problem_of_place(const Scene& scene, const Eigen::Vector3d& place,
                             double free_radius_m) {
  const Aabb& flight = scene.world().flight_bounds;
  if (!flight.contains(place)) return "is out of the flight bounds, " + box_text(flight) + " m";
  if (is_inside(scene, place)) return "is inside an obstacle";
  const double distance_m = scene.nearest(place, free_radius_m).distance_m;
  if (distance_m >= free_radius_m) return "";
  return "has a surface " + fixed_digits(distance_m, 2) +
         " m away, nearer than mission.free_radius_m, " + shortest(free_radius_m) + " m";
}

/// What is wrong with where a listed mission begins and ends, or "".
std::string problem_of_places(const Scene& scene, const MissionSpec& spec, const Mission& mission) {
  for (const auto& [name, place] :
       {std::pair("start", mission.start_world), std::pair("goal", mission.goal_world)}) {
    const std::string problem = problem_of_place(scene, place, spec.free_radius_m);
    if (!problem.empty()) return std::string(name) + " " + place_text(place) + " " + problem;
  }
  const Eigen::Vector3d course = mission.goal_world - mission.start_world;
  // Horizontally, as reaching the goal is judged.
  const double distance_m = math::hypot(course.x(), course.y());
  if (distance_m <= spec.goal_radius_m) {
    return "start " + place_text(mission.start_world) + " is " + fixed_digits(distance_m, 2) +
           " m from the goal, within mission.goal_radius_m, " + shortest(spec.goal_radius_m) + " m";
  }
  return "";
}

}  // namespace

MissionRecord make_mission_record(const TrialSpec& spec, const Scene& scene, ClearanceGrid& grid,
                                  std::int64_t index, const std::vector<Mission>& listed,
                                  std::vector<Eigen::Vector3d>* reference_world) {
  const double radius_m = body_measure(to_eigen(spec.vehicle.body_size_m)).radius_m;
  MissionRecord mission;
  mission.index = index;
  mission.reference_length_m = std::numeric_limits<double>::quiet_NaN();
  const auto made = the_mission(scene, spec, index, listed);
  mission.is_valid = false;
  if (reference_world != nullptr) reference_world->clear();
  if (!made) {
    mission.invalid_reason = "no start or goal with enough free space around it";
    return mission;
  }
  mission.mission = *made;
  // Made missions stand in free places by their making.
  if (!listed.empty()) {
    mission.invalid_reason = problem_of_places(scene, spec.mission, *made);
    if (!mission.invalid_reason.empty()) return mission;
  }
  const auto path = reference_path(grid, *made, spec.mission.goal_radius_m, radius_m);
  if (!path) {
    mission.invalid_reason = "the goal can't be reached";
    return mission;
  }
  mission.is_valid = true;
  mission.reference_length_m = path_length_m(*path);
  // Draws by the mission's index: what was measured before makes no difference.
  mission.difficulty = mission_difficulty(
      scene, *path, radius_m,
      stream_seed(stream_seed(spec.seed, "difficulty"), static_cast<std::uint64_t>(index)));
  if (reference_world != nullptr) *reference_world = *path;
  return mission;
}

MapRecord make_map_record(const TrialSpec& spec, const Scene& scene, std::int64_t mission_count,
                          const std::vector<Mission>& listed) {
  const World& world = scene.world();
  const BodyMeasure body = body_measure(to_eigen(spec.vehicle.body_size_m));
  // One grid for all: what one measure has asked of the scene the others know.
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
    map.missions.push_back(make_mission_record(spec, scene, grid, index, listed));
  }
  return map;
}

std::vector<std::string> mission_problems(const TrialSpec& spec, const Scene& scene,
                                          const std::vector<Mission>& listed) {
  const double radius_m = body_measure(to_eigen(spec.vehicle.body_size_m)).radius_m;
  ClearanceGrid grid(scene, scene.world().bounds, kMapCell_m);
  std::vector<std::string> problems;
  for (const Mission& mission : listed) {
    std::string problem = problem_of_places(scene, spec.mission, mission);
    if (problem.empty() && !reference_path(grid, mission, spec.mission.goal_radius_m, radius_m)) {
      problem = "goal " + place_text(mission.goal_world) + " can't be reached from start " +
                place_text(mission.start_world);
    }
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace avoidbench
