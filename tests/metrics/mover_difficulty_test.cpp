#include "metrics/mover_difficulty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/metric_table.hpp"
#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

TEST(MoverDifficulty, SpeedIsTheMeanOverMoversAndTime) {
  // One of three goes 1 m in each of 10 s of a minute's 61 moments.
  std::vector<Motion> motions{
      {.instance = 0, .path = Route{{{0.0, {0, 0, 0}, 0.0}, {10.0, {10, 0, 0}, 0.0}}}},
      {.instance = 1, .path = Route{{{0.0, {0, 0, 0}, 0.0}}}}};
  EXPECT_DOUBLE_EQ(mean_mover_speed_mps(motions, 3, 60.0), 10.0 / 3.0 / 61.0);
  EXPECT_DOUBLE_EQ(mean_mover_speed_mps(motions, 3, 9.0), 1.0 / 3.0);
}

TEST(MoverDifficulty, NothingIsMetInTheOpenAndAllBehindWalls) {
  const World open = test::flight_world();
  Scene scene(open);
  const Vector3d start(0, -15, 2);
  EXPECT_EQ(dynamic_traversability(scene, start, 0.3, 3.0, 60.0, 1), 1.0);
  // Walls 4 m apart all over: nobody flies 10 m straight on but along them.
  World walls = open;
  for (int i = 0; i < 10; ++i) {
    test::add_obstacle(walls, test::box_mesh({60, 0.2F, 8}), {0, -18.0 + 4.0 * i, 4}, "wall");
    test::add_obstacle(walls, test::box_mesh({0.2F, 60, 8}), {-18.0 + 4.0 * i, 0, 4}, "wall");
  }
  Scene dense(walls);
  EXPECT_EQ(dynamic_traversability(dense, start, 0.3, 3.0, 60.0, 1), 0.0);
}

/// A plate as wide as the box sweeps over it once; who stands still against it is met: of flights
/// much slower than it, those that it has not passed before.
TEST(MoverDifficulty, WhatComesIsMetThoughItsPlaceIsFreeNow) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({60, 0.2F, 8}), {0, -19.5, 4}, "plate");
  Scene still(world);
  const Vector3d start(0, -15, 2);
  const double at_rest = dynamic_traversability(still, start, 0.3, 1.0, 60.0, 1);
  world.motions = {
      {.instance = 1, .path = Route{{{30.0, {0, 0, 0}, 0.0}, {34.0, {0, 39, 0}, 0.0}}}}};
  Scene moving(world);
  const double moved = dynamic_traversability(moving, start, 0.3, 1.0, 60.0, 1);
  EXPECT_GT(at_rest, 0.9);
  // A flight of 10 s that begins evenly within 30 s is still under way at 30 to 34 s with a chance
  // of about a third.
  EXPECT_NEAR(moved, at_rest - 1.0 / 3.0, 0.15);
  EXPECT_EQ(moved, dynamic_traversability(moving, start, 0.3, 1.0, 60.0, 1));
}

TEST(MoverDifficulty, IsMeasuredOfATrialsOwnMovers) {
  const World map = test::flight_world();
  const Scene scene(map);
  TrialSpec spec;
  const MoverDifficulty none = mover_difficulty(spec, scene, test::straight_mission());
  EXPECT_TRUE(std::isnan(none.density_1pm2) && std::isnan(none.speed_mps) &&
              std::isnan(none.dynamic_traversability));
  double before = 1.1;
  for (const std::int64_t count : {16, 160, 640}) {
    spec.movers = {.count = count, .kind = MoverKind::pole, .speed_mps = {1.0, 1.0}};
    const MoverDifficulty found = mover_difficulty(spec, scene, test::straight_mission());
    EXPECT_DOUBLE_EQ(found.density_1pm2, static_cast<double>(count) / 1600.0);
    EXPECT_LT(found.dynamic_traversability, before);
    EXPECT_GT(found.speed_mps, 0.3);
    EXPECT_LT(found.speed_mps, 1.0);
    before = found.dynamic_traversability;
  }
  EXPECT_LT(before, 0.5);
}

TEST(MoverDifficulty, IsInTheTable) {
  TrialRecord record;
  MissionRecord mission;
  mission.mission = test::straight_mission();
  const std::vector<double> with = compute_metrics({TrialSpec{}, mission, record, {1.0, 2.0, 3.0}});
  const std::vector<double> without = compute_metrics({TrialSpec{}, mission, record});
  const std::size_t first = with.size() - 3;
  EXPECT_EQ(metric_table()[first].name, "mover_density_1pm2");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(with[first + i], 1.0 + static_cast<double>(i));
    EXPECT_TRUE(std::isnan(without[first + i]));
  }
}

}  // namespace
}  // namespace avoidbench
