#include "planning/rolling_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace planning {
namespace {

using Eigen::Vector3d;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A level camera at `eye` that looks along +x.
struct Camera {
  std::vector<float> depth_m = std::vector<float>(std::size_t{64} * 48, 3.0F);
  ab_depth_image image{};

  explicit Camera(const Vector3d& eye) {
    image.struct_size = sizeof(image);
    image.width_px = 64;
    image.height_px = 48;
    image.fx_px = image.fy_px = 32.0;
    image.cx_px = 31.5;
    image.cy_px = 23.5;
    for (int k = 0; k < 3; ++k) image.position_world_m[k] = eye[k];
    const double q[4] = {0.5, -0.5, 0.5, -0.5};
    std::copy(q, q + 4, image.q_world_camera);
  }
  void fill(float depth) { depth_m.assign(depth_m.size(), depth); }
  const ab_depth_image& seen() {
    image.depth_m = depth_m.data();
    return image;
  }
};

RollingGridSpec small() {
  RollingGridSpec spec;
  spec.half_size_m = 4.0;
  spec.pixel_step = 1;
  return spec;
}

TEST(RollingGrid, AWallIsOccupiedAfterTwoImagesAndWhatIsBeforeItFree) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  const Cell wall = grid.cell_of({3.0 + 1e-6, 0.05, 2.05});
  EXPECT_EQ(grid.state(wall), CellState::unknown);
  grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(wall), CellState::free);
  grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(wall), CellState::occupied);
  for (double x = 0.15; x < 2.9; x += 0.1) {
    EXPECT_EQ(grid.state(grid.cell_of({x, 0.05, 2.05})), CellState::free) << x;
  }
  EXPECT_EQ(grid.state(grid.cell_of({3.5, 0.05, 2.05})), CellState::unknown);
  EXPECT_EQ(grid.state(grid.cell_of({-1.0, 0.0, 2.0})), CellState::unknown);
}

TEST(RollingGrid, NothingInRangeFreesUpToTheLongestRayAndNanSaysNothing) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  camera.fill(std::numeric_limits<float>::quiet_NaN());
  grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(grid.cell_of({1.0, 0.05, 2.05})), CellState::unknown);
  for (const float depth : {kInfinity, 100.0F}) {
    grid.reset({0, 0, 2});
    camera.fill(depth);
    for (int i = 0; i < 5; ++i) grid.integrate(camera.seen());
    EXPECT_EQ(grid.state(grid.cell_of({3.8, 0.05, 2.05})), CellState::free);
    EXPECT_TRUE(grid.occupied_centers().empty());
  }
}

TEST(RollingGrid, WhatWentAwayIsFreedAgain) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  for (int i = 0; i < 10; ++i) grid.integrate(camera.seen());
  const Cell wall = grid.cell_of({3.0 + 1e-6, 0.05, 2.05});
  ASSERT_EQ(grid.state(wall), CellState::occupied);
  camera.fill(kInfinity);
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(wall), CellState::free);
  EXPECT_FALSE(grid.is_inflated(wall));
}

TEST(RollingGrid, InflationIsTheCubeAroundOccupiedCells) {
  RollingGridSpec spec = small();
  spec.inflation_m = 0.3;
  RollingGrid grid(spec);
  grid.reset({0, 0, 2});
  std::mt19937 random(3);
  Camera camera({0.0, 0.0, 2.0});
  for (int k = 0; k < 4; ++k) {
    for (float& depth : camera.depth_m) depth = 1.0F + static_cast<float>(random() % 300) / 100.0F;
    for (int i = 0; i < 2; ++i) grid.integrate(camera.seen());
    grid.move_to({0.3 * k, -0.2 * k, 2.0});
  }
  const std::vector<Vector3d> occupied = grid.occupied_centers();
  ASSERT_GT(occupied.size(), 100U);
  int inflated = 0;
  for (int i = 0; i < 3000; ++i) {
    const Cell cell(static_cast<int>(random() % 70) - 30, static_cast<int>(random() % 70) - 35,
                    static_cast<int>(random() % 60) - 4);
    if (!grid.contains(cell)) continue;
    bool expected = false;
    for (const Vector3d& center : occupied) {
      expected = expected || ((grid.cell_of(center) - cell).cwiseAbs().maxCoeff() <= 3);
    }
    EXPECT_EQ(grid.is_inflated(cell), expected);
    inflated += expected ? 1 : 0;
  }
  EXPECT_GT(inflated, 100);
}

TEST(RollingGrid, RollingKeepsWhatStaysAndForgetsWhatLeaves) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());
  const std::vector<Vector3d> before = grid.occupied_centers();
  ASSERT_FALSE(before.empty());
  grid.move_to({1.5, -0.7, 2.0});
  for (const Vector3d& center : before) {
    const Cell cell = grid.cell_of(center);
    EXPECT_EQ(grid.state(cell), grid.contains(cell) ? CellState::occupied : CellState::unknown);
  }
  grid.move_to({7.5, 0.0, 2.0});  // the wall at x = 3 is out now
  grid.move_to({0.0, 0.0, 2.0});
  EXPECT_TRUE(grid.occupied_centers().empty());
  grid.move_to({100.0, 50.0, 2.0});
  EXPECT_EQ(grid.state(grid.cell_of({100.0, 50.0, 2.0})), CellState::unknown);
}

TEST(RollingGrid, TheVehiclesOwnPlaceIsFree) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());
  grid.clear_box({3.0, 0.0, 2.0}, {0.6, 0.6, 0.4});
  EXPECT_EQ(grid.state(grid.cell_of({3.05, 0.05, 2.05})), CellState::free);
  EXPECT_EQ(grid.state(grid.cell_of({3.05, 0.55, 2.05})), CellState::occupied);
}

}  // namespace
}  // namespace planning
