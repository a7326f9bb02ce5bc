#include "metrics/difficulty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/environment.hpp"
#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

TEST(AngleOverLength, OfStraightAndBentPaths) {
  EXPECT_EQ(angle_over_length_1pm({{0, 0, 2}, {0, 5, 2}, {0, 9, 2}}), 0.0);
  EXPECT_NEAR(angle_over_length_1pm({{0, 0, 2}, {0, 5, 2}, {5, 5, 2}}), (std::exp(1.0) - 1.0) / 10,
              1e-12);
  // There and back again, and a bend upward.
  EXPECT_NEAR(angle_over_length_1pm({{0, 0, 0}, {0, 4, 0}, {0, 0, 0}}), (std::exp(2.0) - 1.0) / 8,
              1e-12);
  EXPECT_NEAR(angle_over_length_1pm({{0, 0, 0}, {0, 1, 0}, {0, 2, 1}}),
              (std::exp(0.5) - 1.0) / (1.0 + std::sqrt(2.0)), 1e-12);
}

TEST(ViewOcclusion, IsNothingInTheOpen) {
  const World world = test::flight_world();
  const Scene scene(world);
  EXPECT_EQ(view_occlusion(scene, {{0, -10, 6}, {0, 10, 6}}), 0.0);
}

TEST(ViewOcclusion, OfAWallAhead) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({20, 1, 10}), {0, 0.5, 5}, "wall");
  const Scene scene(world);
  // One place, 2 m before the wall, whose nearest point in a ring lies at the ring's inner edge.
  const double found = view_occlusion(scene, {{0, -2.2, 6}, {0, -1.8, 6}});
  const auto inverse = [](double degrees) { return std::cos(degrees * math::kDegree) / 2.0; };
  const double exact =
      4.0 * (0.55 * inverse(0) + 0.3 * inverse(15) + 0.1 * inverse(22.5) + 0.05 * inverse(30));
  EXPECT_NEAR(found, exact, 0.01 * exact);
  EXPECT_EQ(view_occlusion(scene, {{0, -1.8, 6}, {0, -2.2, 6}}), 0.0);  // away from it
}

TEST(TraversabilityObstruction, IsOneHalfInTheOpen) {
  World world = test::flight_world();
  world.bounds.extend(Vector3d(0, 0, 30));
  const Scene scene(world);
  EXPECT_NEAR(traversability_obstruction(scene, {{0, -15, 12}, {0, 15, 12}}, 0.25, 1), 0.5, 1e-12);
}

/// Between two walls `gap_m` apart every sphere has the same radius.
double between_walls(double gap_m, std::uint64_t seed) {
  World world = test::flight_world();
  for (const double side : {-1.0, 1.0}) {
    test::add_obstacle(world, test::box_mesh({1, 40, 20}), {side * (0.5 * gap_m + 0.5), 0, 5},
                       "wall");
  }
  const Scene scene(world);
  return traversability_obstruction(scene, {{0, -15, 6}, {0, 15, 6}}, 0.25, seed);
}

TEST(TraversabilityObstruction, OfACorridorFollowsItsWidth) {
  for (const double gap_m : {1.5, 2.5, 4.0}) {
    const double least = 4.0 / (2.0 * (0.5 * gap_m - 0.25));  // of spheres on the middle line
    const double found = between_walls(gap_m, 1);
    EXPECT_GE(found, least - 1e-9) << gap_m;
    EXPECT_LE(found, 1.1 * least) << gap_m;
  }
}

TEST(TraversabilityObstruction, DependsOnItsSeedAlone) {
  EXPECT_EQ(between_walls(2.0, 7), between_walls(2.0, 7));
  EXPECT_NE(between_walls(2.0, 7), between_walls(2.0, 8));
}

TEST(TraversabilityPointcloud, OfAnEmptyWorldIsItsOwnNorm) {
  const World world = test::flight_world();
  const Traversability found =
      traversability_pointcloud(world, 0.35, body_measure({0.5, 0.5, 0.1}));
  EXPECT_EQ(found.normalized_ratio, 1.0);
  // Along y from row i of 39: whole steps to the sides, 40 m in all; slantwise √2 as far at most.
  EXPECT_GT(found.value, 15.0 / std::sqrt(0.5));
  EXPECT_LT(found.value, 22.0 / std::sqrt(0.5));
}

TEST(TraversabilityPointcloud, IsALittleAboveTheExactOne) {
  World world = test::flight_world();
  world.flight_bounds = Aabb(Vector3d(-20, -20, 1.5), Vector3d(20, 20, 2.5));
  for (int i = -2; i <= 2; ++i) {
    for (int k = -2; k <= 2; ++k) {
      const Vector3d place(7.0 * i + 0.3 * k, 7.0 * k, 0.0);
      test::add_obstacle(world, test::cylinder_mesh(0.6, 9.0, 64), place, "cylinder");
    }
  }
  const Scene scene(world);
  const BodyMeasure body = body_measure({0.5, 0.5, 0.12});
  ClearanceGrid grid(scene, world.bounds, 0.2);
  const double exact = traversability(scene, grid, body).normalized_ratio;
  const double points = traversability_pointcloud(world, 0.25, body).normalized_ratio;
  // Its last step ends at the obstacle, and its points keep a smaller distance than the body.
  EXPECT_GT(points, exact);
  EXPECT_LT(points, 1.15 * exact);
  EXPECT_LT(traversability_pointcloud(world, 0.5, body).normalized_ratio, points);
}

}  // namespace
}  // namespace avoidbench
