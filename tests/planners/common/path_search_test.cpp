#include "planning/path_search.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace planning {
namespace {

using Eigen::Vector3d;

/// A grid in which a wall across x, at x = 2 m, has been seen from the origin, with a way around at
/// y > 1.2 m.
RollingGrid grid_with_wall() {
  RollingGridSpec spec;
  spec.half_size_m = 5.0;
  spec.pixel_step = 1;
  spec.inflation_m = 0.1;
  RollingGrid grid(spec);
  grid.reset({0, 0, 2});
  std::vector<float> depth_m;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const double left = -(u - 79.5) / 80.0 * 2.0;
      depth_m.push_back(left > 1.2 ? std::numeric_limits<float>::infinity() : 2.0F);
    }
  }
  ab_depth_image image{};
  image.width_px = 160;
  image.height_px = 120;
  image.fx_px = image.fy_px = 80.0;
  image.cx_px = 79.5;
  image.cy_px = 59.5;
  image.position_world_m[2] = 2.0;
  const double q[4] = {0.5, -0.5, 0.5, -0.5};
  std::copy(q, q + 4, image.q_world_camera);
  image.depth_m = depth_m.data();
  for (int i = 0; i < 3; ++i) grid.integrate(image);
  return grid;
}

TEST(PathSearch, GoesStraightWhereNothingIsInTheWay) {
  RollingGrid grid{RollingGridSpec{}};
  grid.reset({0, 0, 2});
  PathSearch search{PathSearchSpec{}};
  const auto path = search.find(grid, {-1.95, 0.05, 2.05}, {2.05, 0.05, 2.05});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path_length_m(*path), 4.0, 1e-9);
  EXPECT_TRUE(path->front().isApprox(Vector3d(-1.95, 0.05, 2.05), 1e-9));
  EXPECT_TRUE(path->back().isApprox(Vector3d(2.05, 0.05, 2.05), 1e-9));
  const auto diagonal = search.find(grid, {-0.95, -0.95, 1.05}, {1.05, 1.05, 3.05});
  ASSERT_TRUE(diagonal);
  EXPECT_NEAR(path_length_m(*diagonal), 2.0 * std::sqrt(3.0), 1e-9);
}

TEST(PathSearch, GoesAroundAWallThroughFreeCellsOnly) {
  const RollingGrid grid = grid_with_wall();
  PathSearchSpec spec;
  spec.lowest_m = 1.5;
  spec.highest_m = 2.5;
  PathSearch search(spec);
  const auto path = search.find(grid, {0.05, 0.05, 2.05}, {3.05, 0.05, 2.05});
  ASSERT_TRUE(path);
  EXPECT_GT(path_length_m(*path), 3.7);
  EXPECT_LT(path_length_m(*path), 5.0);
  double most_left = 0.0;
  for (const Vector3d& place : *path) {
    EXPECT_FALSE(grid.is_inflated(place));
    most_left = std::max(most_left, place.y());
  }
  EXPECT_GT(most_left, 1.2);
  const auto again = search.find(grid, {0.05, 0.05, 2.05}, {3.05, 0.05, 2.05});
  EXPECT_EQ(*path, *again);
}

TEST(PathSearch, MovesEndsOutOfObstaclesAndGivesUpOutsideOfItsBox) {
  const RollingGrid grid = grid_with_wall();
  PathSearch search{PathSearchSpec{}};
  const auto path = search.find(grid, {0.05, 0.05, 2.05}, {2.05, 0.05, 2.05});  // in the wall
  ASSERT_TRUE(path);
  EXPECT_FALSE(grid.is_inflated(path->back()));
  EXPECT_FALSE(search.find(grid, {0.05, 0.05, 2.05}, {30.0, 0.05, 2.05}));
}

TEST(PathSearch, SpendsNoMoreThanItsBudget) {
  const RollingGrid grid = grid_with_wall();
  PathSearch search{PathSearchSpec{}};
  const Vector3d start(0.05, 0.05, 2.05), goal(3.05, 0.05, 2.05);
  search.use_budget(100000);
  ASSERT_TRUE(search.find(grid, start, goal));
  search.use_budget(20);
  EXPECT_FALSE(search.find(grid, start, goal));
  EXPECT_FALSE(search.find(grid, start, Vector3d(0.55, 0.05, 2.05))) << "nothing is left";
}

}  // namespace
}  // namespace planning
