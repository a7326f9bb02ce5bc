#include "trial/mission.hpp"

#include "base/math.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

// In a band of which one part in a thousand is free, all of them fail once in 22,000 missions; a
// map like that is too dense to fly.
constexpr int kTries = 10000;

/// A place of the region with free space around it.
std::optional<Eigen::Vector3d> free_place(const Scene& scene, const Region& region,
                                          double free_radius_m, RandomStream& draws) {
  const World& world = scene.world();
  for (int i = 0; i < kTries; ++i) {
    Eigen::Vector3d place;
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = draws.uniform(region.lowest[axis], region.highest[axis]);
    }
    if (world.heights_above_ground) place.z() += ground_height_m(world, place.x(), place.y());
    const bool is_free = scene.nearest(place, free_radius_m).distance_m >= free_radius_m;
    if (is_free && world.flight_bounds.contains(place)) return place;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Mission> make_mission(const Scene& scene, const MissionSpec& spec, std::uint64_t seed,
                                    std::int64_t index) {
  const std::uint64_t mission_seed =
      stream_seed(stream_seed(seed, "mission"), static_cast<std::uint64_t>(index));
  // A stream each: how many tries the start took must not move the goal.
  RandomStream start_draws = stream(mission_seed, "start");
  RandomStream goal_draws = stream(mission_seed, "goal");
  const World& world = scene.world();
  const auto start = free_place(scene, world.start_region, spec.free_radius_m, start_draws);
  const auto goal = free_place(scene, world.goal_region, spec.free_radius_m, goal_draws);
  if (!start || !goal) return std::nullopt;
  return Mission{.start_world = *start,
                 .goal_world = *goal,
                 .start_yaw_rad = yaw_toward_goal_rad(*start, *goal)};
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
