#include "metrics/map_record.hpp"

#include <limits>

#include "base/math.hpp"
#include "base/number_text.hpp"
#include "base/random.hpp"
#include "metrics/environment.hpp"
#include "metrics/reference_path.hpp"
#include "trial/goals.hpp"

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

/// "goal", or "goal 2" of several.
std::string goal_name(const Mission& mission, std::size_t index) {
  return mission.waypoints_world.empty() ? "goal" : "goal " + std::to_string(index + 1);
}

/// What is wrong with where a listed mission begins and ends, or "".
std::string problem_of_places(const Scene& scene, const MissionSpec& spec, const Mission& mission) {
  std::vector<Eigen::Vector3d> places = goals_of(mission);
  places.insert(places.begin(), mission.start_world);
  const auto name = [&](std::size_t i) {
    return i == 0 ? std::string("start") : goal_name(mission, i - 1);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string problem = problem_of_place(scene, places[i], spec.free_radius_m);
    if (!problem.empty()) return name(i) + " " + place_text(places[i]) + " " + problem;
  }
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Eigen::Vector3d course = places[i] - places[i - 1];
    // Horizontally, as reaching the goal is judged.
    const double distance_m = math::hypot(course.x(), course.y());
    if (distance_m > spec.goal_radius_m) continue;
    const std::string to = places.size() == 2 ? "the goal" : name(i);
    return name(i - 1) + " " + place_text(places[i - 1]) + " is " + fixed_digits(distance_m, 2) +
           " m from " + to + ", within mission.goal_radius_m, " + shortest(spec.goal_radius_m) +
           " m";
  }
  if (is_way_free(scene, spec, last_goal_way(spec, mission))) return "";
  return goal_name(mission, mission.waypoints_world.size()) + " " + place_text(mission.goal_world) +
         " moves to where a surface is nearer than mission.free_radius_m, " +
         shortest(spec.free_radius_m) + " m, or out of the flight bounds";
}

}  // namespace

MissionRecord make_mission_record(const TrialSpec& spec, const Scene& scene, ClearanceGrid& grid,
                                  std::int64_t index, const std::vector<Mission>& listed,
                                  std::vector<std::vector<Eigen::Vector3d>>* legs_world) {
  const double radius_m = body_measure(to_eigen(spec.vehicle.body_size_m)).radius_m;
  MissionRecord mission;
  mission.index = index;
  mission.reference_length_m = std::numeric_limits<double>::quiet_NaN();
  const auto made = the_mission(scene, spec, index, listed);
  mission.is_valid = false;
  if (legs_world != nullptr) legs_world->clear();
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
  const auto legs = reference_legs(grid, *made, spec.mission.goal_radius_m, radius_m);
  if (legs.size() < goals_of(*made).size()) {
    mission.invalid_reason =
        (goals_of(*made).size() == 1 ? "the goal" : goal_name(*made, legs.size())) +
        " can't be reached";
    return mission;
  }
  mission.is_valid = true;
  mission.reference_length_m = 0.0;
  for (const std::vector<Eigen::Vector3d>& leg : legs) {
    mission.leg_lengths_m.push_back(path_length_m(leg));
    mission.reference_length_m += mission.leg_lengths_m.back();
  }
  if (legs.size() == 1) mission.leg_lengths_m.clear();
  const std::vector<Eigen::Vector3d> path = joined(legs);
  // Draws by the mission's index: what was measured before makes no difference.
  mission.difficulty = mission_difficulty(
      scene, path, radius_m,
      stream_seed(stream_seed(spec.seed, "difficulty"), static_cast<std::uint64_t>(index)));
  if (legs_world != nullptr) *legs_world = legs;
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
    if (problem.empty()) {
      const std::vector<Eigen::Vector3d> goals = goals_of(mission);
      const std::size_t reached =
          reference_legs(grid, mission, spec.mission.goal_radius_m, radius_m).size();
      if (reached < goals.size()) {
        problem = goal_name(mission, reached) + " " + place_text(goals[reached]) +
                  " can't be reached from " +
                  (reached == 0 ? "start " + place_text(mission.start_world)
                                : goal_name(mission, reached - 1));
      }
    }
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace avoidbench
