#include "metrics/column_distances.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kBallRadius_m = 0.25;
const GoalRegion kRegion{{0.0, 15.0, 2.0}, 0.8};

double bound_m(const World& world, const Vector3d& place) {
  const Scene scene(world);
  ClearanceGrid grid(scene, world.bounds, 0.2);
  return ColumnDistances(grid, kRegion, kBallRadius_m).at_least_m(place);
}

TEST(ColumnDistances, AreNeverLongerThanAStraightFreeWay) {
  const World world = test::flight_world();
  for (int i = 0; i < 36; ++i) {
    const double angle = std::numbers::pi * i / 18.0;
    const Vector3d place(12.0 * std::sin(angle), 12.0 * std::cos(angle), 4.0);
    const double straight_m = (kRegion.center_world - place).head<2>().norm() - kRegion.radius_m;
    EXPECT_NEAR(bound_m(world, place), straight_m, 1e-9) << i;
  }
  EXPECT_EQ(bound_m(world, {0.3, 15.2, 8.0}), 0.0);
}

TEST(ColumnDistances, GoAroundAWallToTheCeiling) {
  World world = test::flight_world();
  // From x = -20 to 12: past its end at (12.25, ±0.1).
  test::add_obstacle(world, test::box_mesh({32, 0.2F, 30}), {-4, 0, 0}, "wall");
  const double around_m = 2.0 * std::hypot(12.25, 14.9) - kRegion.radius_m;
  const double bound = bound_m(world, {0.0, -15.0, 2.0});
  EXPECT_LE(bound, around_m);
  EXPECT_GE(bound, 0.93 * around_m);
}

TEST(ColumnDistances, GoOverWhatIsLow) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({39.9F, 0.2F, 6}), {0, 0, 0}, "wall");  // up to z = 3
  EXPECT_NEAR(bound_m(world, {0.0, -15.0, 2.0}), 30.0 - kRegion.radius_m, 1e-9);
}

TEST(ColumnDistances, AreStraightWhereNoWayLeads) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({41.9F, 0.2F, 30}), {0, 0, 0}, "wall");
  world.bounds = Aabb(Vector3d(-6, -18, -0.5), Vector3d(6, 18, 4));
  EXPECT_NEAR(bound_m(world, {0.0, -15.0, 2.0}), 30.0 - kRegion.radius_m, 1e-9);
}

}  // namespace
}  // namespace avoidbench
