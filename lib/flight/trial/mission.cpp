#include "trial/mission.hpp"

#include <algorithm>
#include <utility>

#include "base/math.hpp"
#include "base/random.hpp"
#include "trial/goals.hpp"

namespace avoidbench {
namespace {

// In a band of which one part in a thousand is free, all of them fail once in 22,000 missions; a
// map like that is too dense to fly.
constexpr int kTries = 10000;

/// A place of the region that is good and has free space around it.
template <class IsGood>
std::optional<Eigen::Vector3d> free_place(const Scene& scene, const Region& region,
                                          double free_radius_m, RandomStream& draws,
                                          IsGood is_good) {
  const World& world = scene.world();
  for (int i = 0; i < kTries; ++i) {
    Eigen::Vector3d place;
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = draws.uniform(region.lowest[axis], region.highest[axis]);
    }
    if (world.heights_above_ground) place.z() += ground_height_m(world, place.x(), place.y());
    const bool is_free = scene.nearest(place, free_radius_m).distance_m >= free_radius_m;
    if (is_free && world.flight_bounds.contains(place) && is_good(place)) return place;
  }
  return std::nullopt;
}

/// The flight bounds in plan, at the heights of starts and goals.
Region waypoint_region(const World& world) {
  Region region{.lowest = world.flight_bounds.min(), .highest = world.flight_bounds.max()};
  region.lowest.z() = std::min(world.start_region.lowest.z(), world.goal_region.lowest.z());
  region.highest.z() = std::max(world.start_region.highest.z(), world.goal_region.highest.z());
  return region;
}

}  // namespace

std::vector<Eigen::Vector3d> goals_of(const Mission& mission) {
  std::vector<Eigen::Vector3d> goals = mission.waypoints_world;
  goals.push_back(mission.goal_world);
  return goals;
}

Mission with_return(Mission mission) {
  mission.waypoints_world.push_back(mission.goal_world);
  mission.goal_world = mission.start_world;
  return mission;
}

std::optional<Mission> make_mission(const Scene& scene, const MissionSpec& spec, std::uint64_t seed,
                                    std::int64_t index) {
  const std::uint64_t mission_seed =
      stream_seed(stream_seed(seed, "mission"), static_cast<std::uint64_t>(index));
  // A stream each: how many tries the start took must not move the goal.
  RandomStream start_draws = stream(mission_seed, "start");
  RandomStream goal_draws = stream(mission_seed, "goal");
  const World& world = scene.world();
  const auto start = free_place(scene, world.start_region, spec.free_radius_m, start_draws,
                                [](const Eigen::Vector3d&) { return true; });
  if (!start) return std::nullopt;
  Mission mission{.start_world = *start};
  const Region region = waypoint_region(world);
  const std::uint64_t waypoint_seed = stream_seed(mission_seed, "waypoint");
  const auto is_apart = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (b - a).head<2>().norm() > spec.goal_radius_m;
  };
  Eigen::Vector3d before = *start;
  for (std::int64_t i = 0; i < spec.waypoints; ++i) {
    RandomStream draws(stream_seed(waypoint_seed, static_cast<std::uint64_t>(i)));
    const auto waypoint =
        free_place(scene, region, spec.free_radius_m, draws,
                   [&](const Eigen::Vector3d& place) { return is_apart(before, place); });
    if (!waypoint) return std::nullopt;
    mission.waypoints_world.push_back(before = *waypoint);
  }
  const auto goal = free_place(scene, world.goal_region, spec.free_radius_m, goal_draws,
                               [&](const Eigen::Vector3d& place) {
                                 return (spec.waypoints == 0 || is_apart(before, place)) &&
                                        is_way_free(scene, spec, goal_way(spec, before, place));
                               });
  if (!goal) return std::nullopt;
  mission.goal_world = *goal;
  mission.start_yaw_rad = yaw_toward_goal_rad(*start, goals_of(mission).front());
  return spec.return_to_start ? with_return(std::move(mission)) : mission;
}

std::optional<Mission> the_mission(const Scene& scene, const TrialSpec& trial, std::int64_t index,
                                   const std::vector<Mission>& listed) {
  if (listed.empty()) return make_mission(scene, trial.mission, trial.seed, index);
  const auto at = static_cast<std::size_t>(index);
  return at < listed.size() ? std::optional(listed[at]) : std::nullopt;
}

double yaw_toward_goal_rad(const Eigen::Vector3d& start_world, const Eigen::Vector3d& goal_world) {
  const Eigen::Vector3d course = goal_world - start_world;
  return math::atan2(course.y(), course.x());
}

}  // namespace avoidbench
