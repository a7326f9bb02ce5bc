#include "trial/goals.hpp"

#include <cmath>

#include "base/math.hpp"

namespace avoidbench {

GoalWay goal_way(const MissionSpec& spec, const Eigen::Vector3d& before_world,
                 const Eigen::Vector3d& place_world) {
  Eigen::Vector3d ahead = place_world - before_world;
  ahead.z() = 0.0;
  const double length_m = ahead.norm();
  // Straight above the goal before it any course will do.
  return {
      .motion = spec.goal_motion,
      .place_world = place_world,
      .ahead_world = length_m > 0.0 ? Eigen::Vector3d(ahead / length_m) : Eigen::Vector3d::UnitX()};
}

Eigen::Vector3d place_at(const GoalWay& way, double time_s) {
  const auto& [motion, place, ahead] = way;
  const Eigen::Vector3d left(-ahead.y(), ahead.x(), 0.0);
  const double flown_m = motion.speed_mps * time_s, extent_m = motion.extent_m;
  if (motion.path == GoalPath::line) {
    // From one end and back is twice the line; it begins in the middle.
    const double phase_m = std::fmod(flown_m + 0.5 * extent_m, 2.0 * extent_m);
    return place +
           left * (phase_m < extent_m ? phase_m - 0.5 * extent_m : 1.5 * extent_m - phase_m);
  }
  if (motion.path == GoalPath::circle) {
    const double radius_m = 0.5 * extent_m;
    const double angle = std::fmod(flown_m / radius_m, math::kTau);
    return place + radius_m * (ahead * math::sin(angle) + left * (1.0 - math::cos(angle)));
  }
  return place;
}

bool is_way_free(const Scene& scene, const MissionSpec& spec, const GoalWay& way) {
  if (way.motion.path == GoalPath::none) return true;
  constexpr double kStep_m = 0.25;
  const double round_m =
      way.motion.extent_m * (way.motion.path == GoalPath::line ? 2.0 : math::kPi);
  const int count = static_cast<int>(std::ceil(round_m / kStep_m));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d place = place_at(way, i * kStep_m / way.motion.speed_mps);
    const bool is_free = scene.world().flight_bounds.contains(place) &&
                         scene.nearest(place, spec.free_radius_m).distance_m >= spec.free_radius_m;
    if (!is_free) return false;
  }
  return true;
}

GoalWay last_goal_way(const MissionSpec& spec, const Mission& mission) {
  const bool is_only = mission.waypoints_world.empty();
  return goal_way(spec, is_only ? mission.start_world : mission.waypoints_world.back(),
                  mission.goal_world);
}

Eigen::Vector3d goal_place(const MissionSpec& spec, const Mission& mission, std::size_t index,
                           double time_s) {
  if (index < mission.waypoints_world.size()) return mission.waypoints_world[index];
  // Asked at each step of each flight, and most goals stand.
  if (spec.goal_motion.path == GoalPath::none) return mission.goal_world;
  return place_at(last_goal_way(spec, mission), time_s);
}

double distance_to_goal_m(const MissionSpec& spec, const Mission& mission, std::size_t index,
                          const Eigen::Vector3d& place_world, double time_s) {
  return (goal_place(spec, mission, index, time_s) - place_world).head<2>().norm();
}

std::string goals_demand(const MissionSpec& spec, const Mission& mission) {
  if (!mission.waypoints_world.empty()) return "several goals";
  return spec.goal_motion.path == GoalPath::none ? "" : "a goal that moves";
}

std::vector<double> goal_times_s(const MissionSpec& spec, const Mission& mission,
                                 const TrialRecord& record) {
  // Who strikes something or leaves the map as it enters a goal has not reached it.
  const bool has_reached_last = record.outcome == Outcome::reached_goal;
  const bool counts_end =
      record.outcome != Outcome::collided && record.outcome != Outcome::left_bounds;
  const std::size_t count = mission.waypoints_world.size() + (has_reached_last ? 1 : 0);
  std::vector<double> times_s;
  for (const Sample& sample : record.samples) {
    if (!counts_end && &sample == &record.samples.back()) break;
    while (times_s.size() < count &&
           distance_to_goal_m(spec, mission, times_s.size(), sample.position_world,
                              sample.time_s) <= spec.goal_radius_m) {
      times_s.push_back(sample.time_s);
    }
  }
  return times_s;
}

}  // namespace avoidbench
