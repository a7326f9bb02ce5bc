#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/input_error.hpp"
#include "metrics/map_record.hpp"
#include "metrics/reference_path.hpp"
#include "render/scene.hpp"

/// The hard cases as a vehicle meets them: what can be flown, and what gets harder.
namespace avoidbench {
namespace {

MapRecord record_of(const MapSpec& map, std::uint64_t map_seed, std::int64_t missions = 1) {
  TrialSpec spec;
  spec.map = map;
  spec.map_seed = map_seed;
  const World world = make_world(map, map_seed);
  const Scene scene(world);
  return make_map_record(spec, scene, missions);
}

TEST(HardCases, EveryMissionCanBeFlown) {
  const std::vector<MapSpec> maps{MazeSpec{},  GapWallsSpec{},  DeadEndsSpec{},
                                  PolesSpec{}, OverhangsSpec{}, GapWallsSpec{.gap_height_m = 1.0}};
  for (const MapSpec& map : maps) {
    const MissionRecord mission = record_of(map, 1).missions.front();
    EXPECT_TRUE(mission.is_valid) << kind(map) << ' ' << mission.invalid_reason;
  }
}

TEST(HardCases, SameSeedSameWorldOtherSeedAnother) {
  for (const MapSpec& map : std::vector<MapSpec>{MazeSpec{}, GapWallsSpec{}, DeadEndsSpec{},
                                                 PolesSpec{}, OverhangsSpec{}}) {
    EXPECT_EQ(make_world(map, 7).digest, make_world(map, 7).digest);
    EXPECT_NE(make_world(map, 7).digest, make_world(map, 8).digest);
  }
}

TEST(HardCases, OpeningWallsShortensTheWayThroughAMaze) {
  const auto length_m = [](double loop_ratio) {
    const MapRecord map = record_of(MazeSpec{.loop_ratio = loop_ratio}, 3);
    return map.missions.front().reference_length_m;
  };
  EXPECT_GT(length_m(0.0), 1.05 * length_m(0.8));
}

TEST(HardCases, TheOnlyWayThroughAGateHasItsSize) {
  // A gate 1.4 m wide lets a ball of 0.65 m pass and stops one of 0.75 m.
  const GapWallsSpec spec{
      .area_m = {10.0, 14.0}, .wall_count = 1, .gaps_per_wall = 1, .gap_height_m = 1.4};
  TrialSpec trial;
  trial.map = spec;
  const World world = make_world(trial.map, 5);
  const Scene scene(world);
  const auto mission = make_mission(scene, trial.mission, 1, 0);
  ASSERT_TRUE(mission.has_value());
  ClearanceGrid grid(scene, world.bounds, 0.1);
  EXPECT_TRUE(reference_path(grid, *mission, 0.8, 0.62).has_value());
  EXPECT_FALSE(reference_path(grid, *mission, 0.8, 0.75).has_value());
}

TEST(HardCases, OverhangsForceAChangeOfHeight) {
  TrialSpec trial;
  trial.map = OverhangsSpec{};
  const World world = make_world(trial.map, 2);
  const Scene scene(world);
  const auto mission = make_mission(scene, trial.mission, 1, 0);
  ASSERT_TRUE(mission.has_value());
  ClearanceGrid grid(scene, world.bounds, 0.2);
  const auto path = reference_path(grid, *mission, 0.8, 0.25);
  ASSERT_TRUE(path.has_value());
  const auto [low, high] = std::minmax_element(
      path->begin(), path->end(),
      [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.z() < b.z(); });
  EXPECT_GT(high->z() - low->z(), 0.5);
}

TEST(HardCases, NarrowerIsLessTraversable) {
  const auto trav = [](const MapSpec& map) { return record_of(map, 4, 0).traversability; };
  EXPECT_LT(trav(MazeSpec{.corridor_m = 1.5}), trav(MazeSpec{.corridor_m = 4.0}));
  EXPECT_LT(trav(PolesSpec{.poisson_radius_m = 1.2}), trav(PolesSpec{.poisson_radius_m = 3.0}));
  EXPECT_LT(trav(DeadEndsSpec{.passage_m = 1.0}), trav(DeadEndsSpec{.passage_m = 6.0}));
}

TEST(HardCases, ContradictionsAreRefused) {
  EXPECT_THROW(make_world(GapWallsSpec{.gaps_per_wall = 10, .gap_width_m = 3.0}, 1), InputError);
  EXPECT_THROW(make_world(GapWallsSpec{.gap_height_m = 5.0}, 1), InputError);
  EXPECT_THROW(make_world(GapWallsSpec{.sill_m = {2.0, 1.0}}, 1), InputError);
  EXPECT_THROW(make_world(OverhangsSpec{.slot_height_m = 4.5}, 1), InputError);
  EXPECT_THROW(make_world(OverhangsSpec{.barrier_count = 20, .thickness_m = 2.0}, 1), InputError);
  EXPECT_THROW(make_world(PolesSpec{.diameter_m = {0.03, 0.01}}, 1), InputError);
  EXPECT_THROW(make_world(DeadEndsSpec{.trap_width_m = 20.0}, 1), InputError);
  EXPECT_THROW(make_world(MazeSpec{.corridor_m = 10.0}, 1), InputError);
  EXPECT_THROW(make_world(MazeSpec{.height_m = 2.0, .flight_height_m = 2.5}, 1), InputError);
}

}  // namespace
}  // namespace avoidbench
