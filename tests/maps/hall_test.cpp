#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/input_error.hpp"
#include "maps/map_spec.hpp"

namespace avoidbench {
namespace {

TEST(Hall, HasAShellAndCylinders) {
  std::map<std::string, int> counts;
  const World world = make_world(HallSpec{}, 1);
  for (const Obstacle& obstacle : world.obstacles) ++counts[obstacle.kind];
  EXPECT_EQ(counts["ground"], 1);
  EXPECT_EQ(counts["wall"], 4);
  EXPECT_EQ(counts["ceiling"], 1);
  EXPECT_GT(counts["cylinder"], 20);
  EXPECT_EQ(counts["lamp"], 24);
  EXPECT_EQ(counts.size(), 5U);
  EXPECT_EQ(world.obstacles[world.instances[0].obstacle].kind, "ground");
  EXPECT_EQ(ground_height_m(world, 5.0, 5.0), 0.0);
  EXPECT_FALSE(world.heights_above_ground);
}

TEST(Hall, ShellIsAroundTheFlightSpace) {
  const World world = make_world(HallSpec{}, 2);
  const Aabb inside = world.flight_bounds;
  EXPECT_EQ(inside.max(), Eigen::Vector3d(20.0, 30.0, 5.0));
  const Aabb core(inside.min().array() + 1e-4, inside.max().array() - 1e-4);
  Aabb whole;
  for (std::size_t i = 0; i < 6; ++i) {
    Aabb slab;
    for (const Eigen::Vector3f& vertex :
         world.prototypes[world.instances[i].prototype].mesh.vertices) {
      slab.extend((world.instances[i].T_world_prototype * vertex).cast<double>());
    }
    EXPECT_FALSE(slab.intersects(core)) << i;
    whole.extend(slab);
  }
  EXPECT_TRUE(whole.contains(inside));
}

TEST(Hall, CylindersReachFromFloorToCeilingInsideTheWalls) {
  const HallSpec spec;
  const World world = make_world(spec, 3);
  double sum_m = 0.0, count = 0.0;
  for (const Instance& instance : world.instances) {
    const Obstacle& obstacle = world.obstacles[instance.obstacle];
    if (obstacle.kind != "cylinder") continue;
    Aabb box;
    for (const Eigen::Vector3f& vertex : world.prototypes[instance.prototype].mesh.vertices) {
      const Eigen::Vector3d corner = (instance.T_world_prototype * vertex).cast<double>();
      box.extend(corner);
      const double away_m = (corner - obstacle.position_world).head<2>().norm();
      EXPECT_NEAR(away_m, 0.5 * obstacle.width_m, 1e-5);
    }
    EXPECT_LE(box.min().z(), 0.0);
    EXPECT_GE(box.max().z(), spec.height_m);
    EXPECT_GE(box.min().x(), -1e-6);
    EXPECT_GE(box.min().y(), -1e-6);
    EXPECT_LE(box.max().x(), 20.0 + 1e-5);
    EXPECT_LE(box.max().y(), 30.0 + 1e-5);
    EXPECT_GE(obstacle.width_m, 0.5);
    EXPECT_LE(obstacle.width_m, 1.0);
    sum_m += obstacle.width_m;
    count += 1.0;
  }
  EXPECT_NEAR(world.mean_obstacle_width_m, sum_m / count, 1e-12);
}

TEST(Hall, TextureOpacityMovesNothingButChangesTheDigest) {
  HallSpec bold, bland;
  bland.texture_opacity = 0.25;
  const World a = make_world(bold, 4);
  const World b = make_world(bland, 4);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  int cylinders = 0;
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].position_world, b.obstacles[i].position_world);
    EXPECT_EQ(a.obstacles[i].width_m, b.obstacles[i].width_m);
    if (a.obstacles[i].kind != "cylinder") continue;
    ++cylinders;
    EXPECT_DOUBLE_EQ(b.obstacles[i].texture_opacity, 0.25 * a.obstacles[i].texture_opacity);
    EXPECT_GE(a.obstacles[i].texture_opacity, 0.8);
    EXPECT_LE(a.obstacles[i].texture_opacity, 1.0);
  }
  EXPECT_GT(cylinders, 10);
  EXPECT_NE(a.digest, b.digest);
}

TEST(Hall, DiametersMoveNoAxisButByTheWallMargin) {
  HallSpec thin = {}, thick = {};
  thin.cylinder_diameter_m = {0.5, 1.0};
  thick.cylinder_diameter_m = {0.9, 1.0};
  const World a = make_world(thin, 5);
  const World b = make_world(thick, 5);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].position_world, b.obstacles[i].position_world);
  }
}

TEST(Hall, BandsAreAtTheEndsOfY) {
  const World world = make_world(HallSpec{}, 6);
  EXPECT_EQ(world.start_region.lowest, Eigen::Vector3d(2.0, 1.0, 2.0));
  EXPECT_EQ(world.start_region.highest, Eigen::Vector3d(18.0, 4.5, 2.0));
  EXPECT_EQ(world.goal_region.lowest, Eigen::Vector3d(2.0, 25.5, 2.0));
  EXPECT_EQ(world.goal_region.highest, Eigen::Vector3d(18.0, 29.0, 2.0));
}

TEST(Hall, FurnitureTakesItsShareOfThePlaces) {
  const HallSpec plain{.area_m = {60.0, 60.0}};
  HallSpec spec = plain;
  spec.crates_ratio = 0.3;
  spec.shelf_ratio = 0.2;
  spec.pillar_ratio = 0.1;
  spec.cylinder_height_m = {1.0, 2.0};
  const World world = make_world(spec, 3);
  std::map<std::string, double> counts;
  for (const Instance& instance : world.instances) {
    const Obstacle& obstacle = world.obstacles[instance.obstacle];
    ++counts[obstacle.kind];
    Aabb box;
    for (const Eigen::Vector3f& vertex : world.prototypes[instance.prototype].mesh.vertices) {
      box.extend((instance.T_world_prototype * vertex).cast<double>());
    }
    if (obstacle.kind == "cylinder") {
      EXPECT_GE(box.max().z(), 1.0 - 1e-6);
      EXPECT_LE(box.max().z(), 2.0 + 1e-6);
    }
    if (obstacle.kind == "pillar") {
      EXPECT_GE(box.max().z(), spec.height_m);
    }
    if (obstacle.kind != "crates" && obstacle.kind != "shelf") continue;
    EXPECT_LT(box.min().z(), 0.0);  // stands on the floor
    EXPECT_GE(box.max().z(), 1.2);
    EXPECT_LE(box.max().z(), 3.2 + 1e-6);
    const double across_m = (box.max() - box.min()).head<2>().norm();
    EXPECT_LE(across_m, 2.0 * obstacle.width_m + 1e-6);
  }
  const double places = counts["cylinder"] + counts["crates"] + counts["shelf"] + counts["pillar"];
  double cylinders = 0.0;  // of the hall without furniture
  for (const Obstacle& obstacle : make_world(plain, 3).obstacles) {
    cylinders += obstacle.kind == "cylinder" ? 1.0 : 0.0;
  }
  EXPECT_EQ(places, cylinders);
  EXPECT_NEAR(counts["crates"] / places, 0.3, 0.08);
  EXPECT_NEAR(counts["shelf"] / places, 0.2, 0.08);
  EXPECT_NEAR(counts["pillar"] / places, 0.1, 0.08);
}

TEST(Hall, TooMuchOrTooLongFurnitureIsRefused) {
  EXPECT_THROW(make_world(HallSpec{.crates_ratio = 0.7, .pillar_ratio = 0.7}, 1), InputError);
  EXPECT_THROW(make_world(HallSpec{.poisson_radius_m = 1.9, .shelf_ratio = 0.1}, 1), InputError);
  EXPECT_THROW(make_world(HallSpec{.cylinder_height_m = {3.0, 2.0}}, 1), InputError);
}

TEST(Hall, MovingCylindersKeepToTheirHalfOfTheGap) {
  const HallSpec spec{.poisson_radius_m = 3.0, .moving_ratio = 0.5, .moving_speed_mps = {0.5, 2.0}};
  const World world = make_world(spec, 5);
  EXPECT_GT(world.motions.size(), 10U);
  const double reach_m = 0.5 * (3.0 - 1.0);
  for (const Motion& motion : world.motions) {
    const Sway& sway = std::get<Sway>(motion.path);
    EXPECT_EQ(world.obstacles[world.instances[motion.instance].obstacle].kind, "cylinder");
    EXPECT_NEAR(sway.amplitude_world.norm(), reach_m, 1e-12);
    EXPECT_EQ(sway.amplitude_world.z(), 0.0);
    EXPECT_GE(greatest_speed_mps(motion), 0.5 - 1e-12);
    EXPECT_LE(greatest_speed_mps(motion), 2.0);
    const double step_s = 1e-4;  // the speed where the way is crossed, by a difference
    const double crossing_s = (1.0 - sway.phase) * sway.period_s;
    const Eigen::Vector3d after = displacement_world(motion, crossing_s + step_s);
    const Eigen::Vector3d before = displacement_world(motion, crossing_s - step_s);
    EXPECT_NEAR((after - before).norm() / (2.0 * step_s), greatest_speed_mps(motion), 1e-4);
    EXPECT_LT(
        (displacement_world(motion, 1.0) - displacement_world(motion, 1.0 + 3.0 * sway.period_s))
            .norm(),
        1e-9);
  }
  World still = world;
  still.motions.clear();
  EXPECT_NE(world_digest(world), world_digest(still));
  EXPECT_EQ(world_digest(still), make_world(HallSpec{.poisson_radius_m = 3.0}, 5).digest);
}

}  // namespace
}  // namespace avoidbench
