#include "metrics/reference_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/environment.hpp"
#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kGoalRadius_m = 0.8, kRadius_m = 0.25;

double reference_length(const World& world, const Mission& mission) {
  const Scene scene(world);
  ClearanceGrid grid(scene, world.bounds, 0.2);
  const auto path = reference_path(grid, mission, kGoalRadius_m, kRadius_m);
  if (!path) return HUGE_VAL;
  EXPECT_EQ(path->front(), mission.start_world);
  EXPECT_LE((path->back() - mission.goal_world).head<2>().norm(), kGoalRadius_m + 1e-9);
  for (std::size_t i = 1; i < path->size(); ++i) {  // free all along, asked of the scene itself
    for (int k = 0; k <= 50; ++k) {
      const Vector3d place = (*path)[i - 1] + k / 50.0 * ((*path)[i] - (*path)[i - 1]);
      EXPECT_GE(scene.nearest(place).distance_m,
                kRadius_m - ClearanceGrid::kSightTolerance_m - 1e-4);
    }
  }
  return path_length_m(*path);
}

TEST(ReferencePath, IsStraightToTheGoalRegionInAnEmptyWorld) {
  EXPECT_NEAR(reference_length(test::flight_world(), test::straight_mission()),
              30.0 - kGoalRadius_m, 1e-9);
}

TEST(ReferencePath, ReachesTheGoalRegionAtAnyHeight) {
  Mission mission = test::straight_mission();
  mission.goal_world.z() = 8.0;
  EXPECT_NEAR(reference_length(test::flight_world(), mission), 30.0 - kGoalRadius_m, 0.01);
}

TEST(ReferencePath, GoesAroundACylinderByTangentsAndArc) {
  for (const double radius_m : {0.3, 0.5, 1.0}) {
    World world = test::flight_world();
    test::add_obstacle(world, test::cylinder_mesh(radius_m, 9.9, 64), {0, 0, 0}, "cylinder");
    // Twice the tangent from 15 m away, the arc between, less what the goal radius saves.
    const double r = radius_m + kRadius_m;
    const double tangent = std::sqrt(15.0 * 15.0 - r * r);
    const double exact = 2.0 * tangent + 2.0 * r * std::asin(r / 15.0) - kGoalRadius_m;
    const double found = reference_length(world, test::straight_mission());
    EXPECT_LT(found, exact * 1.003) << radius_m;
    EXPECT_GT(found, exact * 0.998) << radius_m;
  }
}

TEST(ReferencePath, TakesTheGapInAWall) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({22, 0.2F, 20}), {-9, 0, 0}, "wall");  // x from -20 to 2
  test::add_obstacle(world, test::box_mesh({17.2F, 0.2F, 20}), {11.6, 0, 0},
                     "wall");  // x from 3 to 20.2
  const double found = reference_length(world, test::straight_mission());
  // Past the corner at x = 2, y = ±0.1, a ball's radius away.
  const double by_corner = 2.0 * std::hypot(2.25, 14.9) - kGoalRadius_m;
  EXPECT_GT(found, by_corner * 0.995);
  EXPECT_LT(found, by_corner * 1.01);
}

TEST(ReferencePath, FliesOverALowWallRatherThanAround) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({39.9F, 0.2F, 6}), {0, 0, 0},
                     "wall");  // its top is at z = 3
  const double found = reference_length(world, test::straight_mission());
  const double over = std::hypot(1.25, 14.9) * 2.0 - kGoalRadius_m;
  EXPECT_LT(found, over * 1.01);
  EXPECT_GT(found, (30.0 - kGoalRadius_m));
}

TEST(ReferencePath, SaysWhenThereIsNone) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({41.9F, 0.2F, 30}), {0, 0, 0}, "wall");
  world.bounds = Aabb(Vector3d(-6, -18, -0.5), Vector3d(6, 18, 4));
  EXPECT_EQ(reference_length(world, test::straight_mission()), HUGE_VAL);
}

TEST(Traversability, OfAnEmptyWorldIsItsOwnNorm) {
  const World world = test::flight_world();
  const Scene scene(world);
  ClearanceGrid grid(scene, world.bounds, 0.2);
  const BodyMeasure body = body_measure({0.5, 0.5, 0.12});
  const Traversability found = traversability(scene, grid, body);
  EXPECT_DOUBLE_EQ(found.normalized_ratio, 1.0);
  // Mean distance from inside a square to its side over all positions and directions: side · 0.473.
  EXPECT_NEAR(found.value * body.diameter_m / 40.0, 0.473, 0.01);
  EXPECT_NEAR(free_volume_ratio(scene, grid, body), 1.0, 1e-12);
}

/// Free flight of a disc among discs, in closed form.
double free_flight(const Vector3d& from, const Vector3d& direction,
                   const std::vector<Vector3d>& centres, double reach_m, double limit_m) {
  double free_m = limit_m;
  for (const Vector3d& centre : centres) {
    const Eigen::Vector2d to = (centre - from).head<2>();
    if (to.norm() < reach_m) return 0.0;
    const double along = to.dot(direction.head<2>());
    const double square = reach_m * reach_m - (to.squaredNorm() - along * along);
    if (along > 0.0 && square > 0.0) free_m = std::min(free_m, along - std::sqrt(square));
  }
  return free_m;
}

TEST(Traversability, BeforeOneWallAgreesWithClosedForm) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({60, 1, 12}), {0, 5.2, 5}, "wall");  // y 4.7 to 5.7
  const Scene scene(world);
  ClearanceGrid grid(scene, world.bounds, 0.2);
  const BodyMeasure body = body_measure({0.5, 0.5, 0.12});
  double sum = 0.0;
  for (int ix = 0; ix < 40; ++ix) {
    for (int iy = 0; iy < 40; ++iy) {
      const double x = ix - 19.5, y = iy - 19.5;
      if (y > 4.45 && y < 5.95) continue;  // too near the wall
      for (int h = 0; h < 16; ++h) {
        const double dx = std::cos(math::kTau * h / 16), dy = std::sin(math::kTau * h / 16);
        double limit = HUGE_VAL;
        if (std::abs(dx) > 1e-9) limit = std::min(limit, ((dx > 0 ? 20 : -20) - x) / dx);
        if (std::abs(dy) > 1e-9) limit = std::min(limit, ((dy > 0 ? 20 : -20) - y) / dy);
        const double to_wall = y < 4.45 ? 4.45 - y : 5.95 - y;
        if (std::abs(dy) > 1e-9 && to_wall / dy > 0) limit = std::min(limit, to_wall / dy);
        sum += limit;
      }
    }
  }
  const Traversability found = traversability(scene, grid, body);
  EXPECT_NEAR(found.value, sum / (1600.0 * 16.0) / body.diameter_m, 0.003 * found.value);
}

/// Exact and found normalised traversability among upright cylinders.
std::pair<double, double> among_cylinders(int a_side, double apart_m, double radius_m) {
  World world = test::flight_world();
  std::vector<Vector3d> centres;
  for (int i = -a_side; i <= a_side; ++i) {
    for (int k = -a_side; k <= a_side; ++k) {
      centres.emplace_back(apart_m * i + 0.3 * k, apart_m * k, 0.0);
      test::add_obstacle(world, test::cylinder_mesh(radius_m, 9.0, 64), centres.back(), "cylinder");
    }
  }
  const Scene scene(world);
  ClearanceGrid grid(scene, world.bounds, 0.2);
  double sum = 0.0, all = 0.0;
  for (int ix = 0; ix < 40; ++ix) {
    for (int iy = 0; iy < 40; ++iy) {
      for (int h = 0; h < 16; ++h) {
        const Vector3d from(ix - 19.5, iy - 19.5, 2.0);
        const double heading = math::kTau * h / 16.0;
        const Vector3d direction(std::cos(heading), std::sin(heading), 0.0);
        double limit = HUGE_VAL;
        for (int axis = 0; axis < 2; ++axis) {
          if (std::abs(direction[axis]) < 1e-12) continue;
          limit = std::min(limit,
                           ((direction[axis] > 0 ? 20.0 : -20.0) - from[axis]) / direction[axis]);
        }
        sum += free_flight(from, direction, centres, radius_m + kRadius_m, limit);
        all += limit;
      }
    }
  }
  const Traversability found = traversability(scene, grid, body_measure({0.5, 0.5, 0.12}));
  EXPECT_NEAR(found.value, found.normalized_ratio * all / (1600.0 * 16.0) / std::sqrt(0.5),
              1e-9 * found.value);
  return {sum / all, found.normalized_ratio};
}

TEST(Traversability, AmongCylindersAgreesWithClosedForm) {
  const auto [exact, found] = among_cylinders(2, 7.0, 0.6);
  EXPECT_NEAR(found, exact, 0.001 * exact);
}

TEST(Traversability, AmongPolesIsThatOfTheWholeBody) {
  const auto [exact, found] = among_cylinders(4, 3.5, 0.15);  // a body 5 mm smaller: 0.5 % more
  EXPECT_NEAR(found, exact, 0.001 * exact);
}

TEST(Traversability, NothingFliesInsideBigObstacles) {
  // Within the cylinder the nearest surface is up to 3 m away, with room for the body.
  const auto [exact, found] = among_cylinders(1, 12.0, 3.0);
  EXPECT_NEAR(found, exact, 0.002 * exact);
}

/// A bush's shell may lie less than a tenth of a millimetre above the ground.
TEST(Traversability, StandsOnTheGroundOfADenseForest) {
  const World world = make_world(ForestSpec{.poisson_radius_m = 2.1}, 1);
  const Scene scene(world);
  ClearanceGrid grid(scene, world.bounds, 0.2);
  const Traversability measured = traversability(scene, grid, body_measure({0.6, 0.6, 0.3}));
  EXPECT_GT(measured.normalized_ratio, 0.05);
  EXPECT_LT(measured.normalized_ratio, 0.5);
}

TEST(IsInside, TellsSolidsFromAir) {
  World world = test::flight_world();
  test::add_obstacle(world, test::cylinder_mesh(0.8, 8.0, 32), {0, 0, 0}, "cylinder");
  const Scene scene(world);
  EXPECT_TRUE(is_inside(scene, {0.1, 0.1, 2.0}));
  EXPECT_FALSE(is_inside(scene, {1.5, 0.1, 2.0}));
  EXPECT_FALSE(is_inside(scene, {-5.0, 3.0, 0.5}));
}

TEST(ObstacleDensity, CountsWhatStandsInTheFlightSpace) {
  World world = test::flight_world();
  const Eigen::Vector3d size = world.flight_bounds.sizes();
  for (const Eigen::Vector3d& outside :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2.0 * size.x(), 0, 0),
        Eigen::Vector3d(0, 2.0 * size.y(), 0)}) {
    const Eigen::Vector3d foot = world.flight_bounds.center() + outside;
    test::add_obstacle(world, test::cylinder_mesh(0.8, 8.0, 32), {foot.x(), foot.y(), 0},
                       "cylinder");
  }
  EXPECT_EQ(obstacle_count(world), 3);
  EXPECT_NEAR(obstacle_density_1pm2(world) * size.x() * size.y(), 1.0, 1e-12);
}

TEST(RelativeGapSize, FollowsTheText) {
  World world = test::flight_world();
  const BodyMeasure body = body_measure({0.5, 0.5, 0.12});
  EXPECT_TRUE(std::isnan(relative_gap_size(world, body)));
  world.poisson_radius_m = 3.5;
  world.mean_obstacle_width_m = 0.8;
  EXPECT_NEAR(relative_gap_size(world, body), 2.7 / std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace avoidbench
