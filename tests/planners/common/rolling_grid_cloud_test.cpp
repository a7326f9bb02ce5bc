#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "planning/rolling_grid.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;

/// A sweep of a level lidar at (0, 0, 2).
struct Sweep {
  std::vector<ab_lidar_point> points;
  std::vector<float> misses;
  ab_cloud cloud{};

  Sweep() {
    cloud.struct_size = sizeof(cloud);
    cloud.position_world_m[2] = 2.0;
    cloud.q_world_lidar[0] = 1.0;
  }
  void add(double x, double y, double z) {
    points.push_back(
        {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z - 2.0)}, 0.0F, 0.3F});
  }
  void miss(double x, double y, double z) {
    for (const double v : {x, y, z}) misses.push_back(static_cast<float>(v));
  }
  const ab_cloud& seen() {
    cloud.points = points.data();
    cloud.point_count = static_cast<std::uint32_t>(points.size());
    cloud.misses_lidar = misses.data();
    cloud.miss_count = static_cast<std::uint32_t>(misses.size() / 3);
    return cloud;
  }
};

RollingGrid small_grid() {
  RollingGridSpec spec;
  spec.half_size_m = 4.0;
  RollingGrid grid(spec);
  grid.reset({0, 0, 2});
  return grid;
}

TEST(RollingGridOfClouds, APointIsOccupiedAfterTwoSweepsAndItsWayFree) {
  RollingGrid grid = small_grid();
  Sweep sweep;
  sweep.add(3.03, 0.04, 2.05);
  grid.integrate(sweep.seen());
  const Cell end = grid.cell_of({3.03, 0.04, 2.05});
  EXPECT_EQ(grid.state(end), CellState::free);  // one hit is not enough
  grid.integrate(sweep.seen());
  EXPECT_EQ(grid.state(end), CellState::occupied);
  for (double x = 0.05; x < 2.95; x += 0.1) {
    EXPECT_EQ(grid.state(grid.cell_of({x, 0.04 * x / 3.03, 2.0 + 0.05 * x / 3.03})),
              CellState::free)
        << x;
  }
  EXPECT_EQ(grid.state(grid.cell_of({3.15, 0.04, 2.05})), CellState::unknown);
  EXPECT_EQ(grid.state(grid.cell_of({1.0, 0.5, 2.0})), CellState::unknown);
}

TEST(RollingGridOfClouds, ACellCountsOnceASweep) {
  RollingGrid grid = small_grid();
  Sweep sweep;
  for (int i = 0; i < 20; ++i) sweep.add(3.02 + 0.003 * i, 0.04, 2.05);
  grid.integrate(sweep.seen());
  EXPECT_EQ(grid.state(grid.cell_of({3.05, 0.04, 2.05})), CellState::free);
}

TEST(RollingGridOfClouds, ShotsThatMeetNothingFreeUpToTheLongestRay) {
  RollingGrid grid = small_grid();
  Sweep sweep;
  sweep.miss(0.0, -1.0, 0.0);
  sweep.add(0.05, 60.0, 2.05);  // beyond the longest ray: free up to it, too
  grid.integrate(sweep.seen());
  EXPECT_EQ(grid.state(grid.cell_of({0.0, -3.9, 2.0})), CellState::free);
  EXPECT_EQ(grid.state(grid.cell_of({0.0, 3.9, 2.0})), CellState::free);
  EXPECT_TRUE(grid.occupied_centers().empty());
}

/// A wall that is seen flat stays, although rays to its far end pass through cells of its near one.
TEST(RollingGridOfClouds, AGrazedWallStays) {
  RollingGrid grid = small_grid();
  // The plane y = 0.53, along which points lie 0.25 m apart, by turns between each other.
  for (int sweep_index = 0; sweep_index < 12; ++sweep_index) {
    Sweep sweep;
    for (double x = 1.0 + 0.08 * (sweep_index % 3); x < 3.9; x += 0.25) sweep.add(x, 0.53, 2.05);
    grid.integrate(sweep.seen());
  }
  int occupied = 0, all = 0;
  for (double x = 1.25; x < 3.6; x += 0.1, ++all) {
    if (grid.state(grid.cell_of({x, 0.53, 2.05})) == CellState::occupied) ++occupied;
  }
  EXPECT_GE(occupied, all - 2);
}

/// What has gone is freed by rays that go on behind it.
TEST(RollingGridOfClouds, WhatIsGoneIsFreed) {
  RollingGrid grid = small_grid();
  Sweep near, far;
  near.add(2.05, 0.05, 2.05);
  far.add(3.75, 0.05 * 3.75 / 2.05, 2.0 + 0.05 * 3.75 / 2.05);
  for (int i = 0; i < 4; ++i) grid.integrate(near.seen());
  const Cell there = grid.cell_of({2.05, 0.05, 2.05});
  ASSERT_EQ(grid.state(there), CellState::occupied);
  for (int i = 0; i < 6; ++i) grid.integrate(far.seen());
  EXPECT_EQ(grid.state(there), CellState::free);
}

TEST(RollingGridOfClouds, WhatCanNotBeSaysNothing) {
  RollingGrid grid = small_grid();
  Sweep sweep;
  sweep.add(std::nan(""), 0.0, 2.0);
  sweep.add(1e30, 0.0, 2.0);
  sweep.add(0.0, 0.0, 2.0);
  sweep.miss(0.0, 0.0, 0.0);
  sweep.miss(std::nan(""), 1.0, 0.0);
  grid.integrate(sweep.seen());
  EXPECT_TRUE(grid.occupied_centers().empty());
  sweep.add(3.0, 0.0, 2.0);
  sweep.cloud.q_world_lidar[0] = 0.0;
  grid.integrate(sweep.seen());
  sweep.cloud.q_world_lidar[0] = 1.0;
  sweep.cloud.position_world_m[0] = std::nan("");
  grid.integrate(sweep.seen());
  EXPECT_EQ(grid.state(grid.cell_of({1.0, 0.0, 2.0})), CellState::unknown);
  // From outside of the grid nothing is passed, and points inside are hit all the same.
  sweep.cloud.position_world_m[0] = -4.3;
  for (int i = 0; i < 2; ++i) grid.integrate(sweep.seen());
  EXPECT_EQ(grid.state(grid.cell_of({-1.25, 0.0, 2.0})), CellState::occupied);
}

/// Wherever the grid has rolled to, cells are those of the world.
TEST(RollingGridOfClouds, RollsWithTheVehicle) {
  RollingGrid grid = small_grid();
  grid.move_to({5.3, -2.7, 2.0});
  Sweep sweep;
  sweep.cloud.position_world_m[0] = 5.3;
  sweep.cloud.position_world_m[1] = -2.7;
  sweep.add(1.52, 1.31, 2.05);
  for (int i = 0; i < 2; ++i) grid.integrate(sweep.seen());
  const std::vector<Vector3d> occupied = grid.occupied_centers();
  ASSERT_EQ(occupied.size(), 1U);
  EXPECT_LT((occupied[0] - Vector3d(6.82, -1.39, 2.05)).cwiseAbs().maxCoeff(), 0.0501);
  EXPECT_EQ(grid.state(grid.cell_of({5.9, -2.19, 2.02})), CellState::free);
}

}  // namespace
}  // namespace planning
