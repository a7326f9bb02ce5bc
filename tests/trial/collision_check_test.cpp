#include "trial/collision_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/pose.hpp"
#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// A pole of 0.2 m at (0.5, 0), and a body of half a metre.
struct BesideAPole : testing::Test {
  BesideAPole() {
    test::add_obstacle(world, test::cylinder_mesh(0.2, 8.0, 24), {0.5, 0.0, 0.0}, "pole");
  }
  static Pose at(double x_m, double z_m = 4.0) {
    return make_pose({x_m, 0.0, z_m}, Eigen::Quaterniond::Identity());
  }

  World world = test::flight_world();
  CollisionCheck check{.body_size_m = {0.5, 0.5, 0.2}};
};

TEST_F(BesideAPole, TheFirstStepIsLookedAt) {
  const Scene scene(world);
  EXPECT_TRUE(contact(check, scene, at(0.1, 0.5)).has_value());
}

TEST_F(BesideAPole, TheClearanceIsFromTheBox) {
  const Scene scene(world);
  EXPECT_NEAR(body_clearance(check, scene, at(-0.5), 5.0), 1.0 - 0.25 - 0.2, 1e-6);
  EXPECT_NEAR(body_clearance(check, scene, at(-3.0), 5.0), 3.5 - 0.25 - 0.2, 1e-6);
  EXPECT_EQ(body_clearance(check, scene, at(-3.0), 1.0), 1.0);
  EXPECT_EQ(body_clearance(check, scene, at(0.4), 1.0), 0.0);
}

TEST_F(BesideAPole, ContactIsTheSameHoweverSmallTheSteps) {
  const Scene scene(world);
  // Upright sides: they touch where the box's face reaches the pole, at x = 0.05.
  for (const double step_m : {0.3, 0.01, 0.001}) {
    CollisionCheck fresh{.body_size_m = check.body_size_m};
    double x_m = -3.0;
    while (x_m < 1.0 && !contact(fresh, scene, at(x_m))) x_m += step_m;
    EXPECT_GE(x_m, 0.05 - 1e-6) << step_m;
    EXPECT_LT(x_m, 0.05 + step_m + 1e-6) << step_m;
  }
}

TEST_F(BesideAPole, ObstaclesThatMovedAreLookedAtAgain) {
  const Scene far_scene(world);
  ASSERT_FALSE(contact(check, far_scene, at(-1.0)).has_value());
  World nearer = world;
  nearer.instances.back().T_world_prototype.translation().x() = -0.7F;
  const Scene scene(nearer);
  move_obstacles(check, 1.2);
  EXPECT_TRUE(contact(check, scene, at(-1.0)).has_value());
  EXPECT_NEAR(nearest_surface(check, scene, {-2.0, 0.0, 4.0}, 5.0).distance_m, 1.1, 1e-6);
}

}  // namespace
}  // namespace avoidbench
