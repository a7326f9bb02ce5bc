#include <gtest/gtest.h>

#include "maps/map_spec.hpp"
#include "metrics/environment.hpp"
#include "metrics/fast_marching.hpp"
#include "metrics/map_record.hpp"
#include "metrics/reference_path.hpp"
#include "metrics/taut_path.hpp"

/// Reference paths on maps of every generator, against a second search by other means.
namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

constexpr std::uint64_t kSweepSeed = 11;

std::vector<MapSpec> maps_of_all_kinds() {
  return {
      HallSpec{.area_m = {16.0, 24.0}, .poisson_radius_m = 2.6},
      HallSpec{},
      HallSpec{
          .poisson_radius_m = 2.6, .crates_ratio = 0.3, .shelf_ratio = 0.3, .pillar_ratio = 0.2},
      HallSpec{.poisson_radius_m = 2.2, .cylinder_height_m = {0.5, 4.0}},
      ForestSpec{.area_m = {20.0, 20.0}, .poisson_radius_m = 2.1},
      ForestSpec{},
      AvoidbenchForestSpec{},
      AvoidbenchIndoorSpec{},
      MazeSpec{},
      GapWallsSpec{},
      GapWallsSpec{.gap_height_m = 1.0},
      DeadEndsSpec{},
      PolesSpec{},
      OverhangsSpec{},
      OverhangsSpec{.slot_height_m = 0.7}};
}

/// What a map's missions are measured on.
struct Place {
  Place(const MapSpec& map, std::uint64_t seed) : world(make_world(map, seed)), scene(world) {
    trial.map = map;
    trial.map_seed = seed;
    trial.seed = kSweepSeed;
    radius_m = body_measure(to_eigen(trial.vehicle.body_size_m)).radius_m;
    name = std::string(kind(map)) + ", map seed " + std::to_string(seed);
  }
  World world;
  Scene scene;
  TrialSpec trial;
  double radius_m = 0.25;
  std::string name;
  ClearanceGrid grid{scene, world.bounds, kMapCell_m};
};

std::optional<Path> path_of(Place& place, const Mission& mission) {
  return reference_path(place.grid, mission, place.trial.mission.goal_radius_m, place.radius_m);
}

/// The path begins at the start, stays within the bounds and outside the goal's circle, ends on it.
void check_shape(const Place& place, const Mission& mission, const Path& path) {
  const double goal_radius_m = place.trial.mission.goal_radius_m;
  const auto from_goal_m = [&](const Vector3d& point) {
    return (point - mission.goal_world).head<2>().norm();
  };
  EXPECT_EQ(path.front(), mission.start_world);
  EXPECT_LE(from_goal_m(path.back()), goal_radius_m);
  for (const Vector3d& point : path) EXPECT_TRUE(place.world.bounds.contains(point));
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (int k = 0; k < 500; ++k) {
      const Vector3d point = path[i - 1] + k / 500.0 * (path[i] - path[i - 1]);
      EXPECT_GT(from_goal_m(point), goal_radius_m * (1.0 - 1e-9)) << place.name;
    }
  }
}

/// How much shorter the second search's path is [%].
double beaten_by_pct(const Place& place, const Mission& mission, const Path& path) {
  const double length_m = path_length_m(path);
  const test::SecondSearch second{.scene = place.scene,
                                  .mission = mission,
                                  .goal_radius_m = place.trial.mission.goal_radius_m,
                                  .radius_m = place.radius_m,
                                  .limit_m = 1.001 * length_m};
  const auto other = test::second_path(second);
  return other ? 100.0 * (1.0 - test::length_m(*other) / length_m) : -HUGE_VAL;
}

/// Checks missions 0 … `missions` − 1 of map seeds 1 … `seeds`; returns how many had a path.
int check_maps(const std::vector<MapSpec>& maps, std::uint64_t seeds, std::int64_t missions,
               bool by_second_search) {
  int checked = 0;
  for (const MapSpec& map : maps) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Place place(map, seed);
      for (std::int64_t index = 0; index < missions; ++index) {
        const auto mission = make_mission(place.scene, place.trial.mission, kSweepSeed, index);
        const auto path = mission ? path_of(place, *mission) : std::nullopt;
        if (!path) continue;
        ++checked;
        check_shape(place, *mission, *path);
        if (!by_second_search) continue;
        EXPECT_LE(beaten_by_pct(place, *mission, *path), 0.5) << place.name << " mission " << index;
      }
    }
  }
  return checked;
}

TEST(ReferenceSearch, CutsThePathWhereItEntersTheGoalCircle) {
  // The straight way from the last corner to the rim's nearest point grazes a cylinder.
  Place place(HallSpec{.area_m = {16.0, 24.0}, .poisson_radius_m = 2.6}, 3);
  const auto mission = make_mission(place.scene, place.trial.mission, kSweepSeed, 1);
  const auto path = path_of(place, *mission);
  ASSERT_TRUE(path.has_value());
  check_shape(place, *mission, *path);
  EXPECT_NEAR(path_length_m(*path), 19.215, 0.01);
}

TEST(ReferenceSearch, IsNotBeatenOnMapsOfAllKinds) {
  EXPECT_GE(check_maps(maps_of_all_kinds(), 1, 1, true), 14);
}

TEST(ReferenceSearchSlow, IsNotBeatenOnFiveHundredMissions) {
  EXPECT_GE(check_maps(maps_of_all_kinds(), 6, 6, true), 500);
}

TEST(GoalRegion, IsEnteredAtItsRim) {
  const GoalRegion goal{{10.0, 0.0, 2.0}, 0.8};
  const auto entered = first_entry(goal, {0.0, 0.0, 5.0}, {20.0, 0.0, 3.0});
  ASSERT_TRUE(entered.has_value());
  EXPECT_TRUE(goal.contains(*entered));
  EXPECT_NEAR((*entered - Vector3d(9.2, 0.0, 4.08)).norm(), 0.0, 1e-9);
  EXPECT_FALSE(first_entry(goal, {0.0, 0.0, 2.0}, {9.1, 0.0, 2.0}).has_value());
  EXPECT_FALSE(first_entry(goal, {0.0, 0.9, 2.0}, {20.0, 0.9, 2.0}).has_value());
  EXPECT_FALSE(first_entry(goal, {11.0, 0.0, 2.0}, {20.0, 0.0, 2.0}).has_value());
  Path path{{0, 0, 2}, {9.9, 0, 2}, {12, 0, 2}, {10, 0, 2}};
  cut_at_goal(goal, path);
  ASSERT_EQ(path.size(), 2U);
  EXPECT_NEAR(path.back().x(), 9.2, 1e-9);
}

TEST(ReferenceSearch, BendsOnceMoreJustBeforeTheGoalCircle) {
  // The end can slide on only when the line to it has got a corner of its own; else 23.067 m.
  Place place(HallSpec{}, 3);
  const auto mission = make_mission(place.scene, place.trial.mission, kSweepSeed, 5);
  const auto path = path_of(place, *mission);
  ASSERT_TRUE(path.has_value());
  EXPECT_LT(path_length_m(*path), 22.95);
}

}  // namespace
}  // namespace avoidbench
