#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/math.hpp"
#include "maps/map_spec.hpp"

namespace avoidbench {
namespace {

std::vector<const Obstacle*> plants(const World& world) {
  std::vector<const Obstacle*> found;
  for (const Obstacle& obstacle : world.obstacles) {
    if (obstacle.kind == "tree" || obstacle.kind == "bush") found.push_back(&obstacle);
  }
  return found;
}

TEST(Forest, GroundIsTheMeshAndHasTheRelief) {
  ForestSpec spec;
  spec.ground_relief_m = 1.5;
  const World world = make_world(spec, 4);
  ASSERT_EQ(world.obstacles[0].kind, "ground");
  const TriangleMesh& mesh = world.prototypes[world.instances[0].prototype].mesh;
  ASSERT_TRUE(world.instances[0].T_world_prototype.matrix().isIdentity(0.0F));
  double low = 1e9, high = -1e9;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[triangle[1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices[triangle[2]].cast<double>();
    const Eigen::Vector3d middle = 0.2 * a + 0.3 * b + 0.5 * c;
    ASSERT_NEAR(ground_height_m(world, middle.x(), middle.y()), middle.z(), 1e-9);
    ASSERT_GT((b - a).cross(c - a).z(), 0.0);
    low = std::min({low, a.z(), b.z(), c.z()});
    high = std::max({high, a.z(), b.z(), c.z()});
  }
  EXPECT_EQ(low, 0.0);
  EXPECT_EQ(high, 1.5);
}

TEST(Forest, GroundIsContinuousAndUndulatesGently) {
  const World world = make_world(ForestSpec{}, 5);
  constexpr double kStep_m = 0.01;
  double steepest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double x = i * kStep_m;
    const double y = 3.0 + 0.7 * x;
    const double step =
        ground_height_m(world, x + kStep_m, y + 0.7 * kStep_m) - ground_height_m(world, x, y);
    steepest = std::max(steepest, std::abs(step) / kStep_m);
  }
  EXPECT_LT(steepest, 0.6);
  EXPECT_GT(steepest, 0.005);
  EXPECT_EQ(ground_height_m(world, -1e4, 5.0), ground_height_m(world, -20.0, 5.0));
}

TEST(Forest, FlatWhereNoReliefIsWanted) {
  ForestSpec spec;
  spec.ground_relief_m = 0.0;
  const World world = make_world(spec, 6);
  EXPECT_EQ(ground_height_m(world, 12.3, 4.5), 0.0);
}

TEST(Forest, PlantsStandOnTheGroundInsideTheArea) {
  const World world = make_world(ForestSpec{}, 7);
  ASSERT_EQ(world.instances.size(), world.obstacles.size());
  for (std::size_t i = 1; i < world.instances.size(); ++i) {
    const Instance& instance = world.instances[i];
    const Obstacle& obstacle = world.obstacles[instance.obstacle];
    const Eigen::Vector3d& foot = obstacle.position_world;
    EXPECT_TRUE(instance.T_world_prototype.translation().isApprox(foot.cast<float>()));
    EXPECT_EQ(foot.z(), ground_height_m(world, foot.x(), foot.y()));
    EXPECT_TRUE(foot.x() >= 0.0 && foot.x() < 40.0 && foot.y() >= 0.0 && foot.y() < 40.0);
    EXPECT_GT(obstacle.width_m, 0.05);
    EXPECT_LT(obstacle.width_m, 3.0);
    const Eigen::Matrix3f linear = instance.T_world_prototype.linear();
    const float scale = std::cbrt(linear.determinant());
    EXPECT_GE(scale, 0.81F);
    EXPECT_LE(scale, 1.19F);
    EXPECT_TRUE((linear * linear.transpose() / (scale * scale)).isIdentity(1e-5F));
    EXPECT_GT(linear(2, 2) / scale, 0.997F);  // within about 4 degrees
  }
}

TEST(Forest, BushRatioIsMetAndMovesNoPlant) {
  ForestSpec few, many;
  few.bush_ratio = 0.2;
  many.bush_ratio = 0.6;
  const World a = make_world(few, 8);
  const World b = make_world(many, 8);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  double bushes_a = 0.0, bushes_b = 0.0;
  for (std::size_t i = 1; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].position_world, b.obstacles[i].position_world);
    EXPECT_EQ(a.instances[i].T_world_prototype.matrix(), b.instances[i].T_world_prototype.matrix());
    bushes_a += a.obstacles[i].kind == "bush" ? 1.0 : 0.0;
    bushes_b += b.obstacles[i].kind == "bush" ? 1.0 : 0.0;
    if (a.obstacles[i].kind == "bush") {
      EXPECT_EQ(b.obstacles[i].kind, "bush");
    }
  }
  const auto count = static_cast<double>(a.obstacles.size() - 1);
  EXPECT_NEAR(bushes_a, 0.2 * count, 0.5);
  EXPECT_NEAR(bushes_b, 0.6 * count, 0.5);
}

TEST(Forest, ReliefMovesNoPlantSideways) {
  ForestSpec flat, hilly;
  flat.ground_relief_m = 0.0;
  hilly.ground_relief_m = 2.0;
  const World a = make_world(flat, 9);
  const World b = make_world(hilly, 9);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 1; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].position_world.head<2>(), b.obstacles[i].position_world.head<2>());
  }
}

TEST(Forest, BandsAndBoundsAreThoseOfTheOriginal) {
  const World world = make_world(ForestSpec{}, 10);
  EXPECT_EQ(world.start_region.lowest, Eigen::Vector3d(2.0, 0.0, 2.0));
  EXPECT_EQ(world.start_region.highest, Eigen::Vector3d(38.0, 6.0, 2.0));
  EXPECT_EQ(world.goal_region.lowest, Eigen::Vector3d(2.0, 34.0, 2.0));
  EXPECT_EQ(world.goal_region.highest, Eigen::Vector3d(38.0, 40.0, 2.0));
  EXPECT_TRUE(world.heights_above_ground);
  EXPECT_TRUE(world.bounds.contains(world.flight_bounds));
  EXPECT_EQ(world.flight_bounds.max(), Eigen::Vector3d(40.0, 40.0, 6.4));
  EXPECT_LT(world.flight_bounds.min().z(), 0.0);
  EXPECT_EQ(world.bounds.max() - world.flight_bounds.max(), Eigen::Vector3d(3.0, 3.0, 0.0));
}

TEST(Forest, MeanWidthIsThatOfThePlants) {
  const World world = make_world(ForestSpec{}, 11);
  double sum_m = 0.0;
  for (const Obstacle* plant : plants(world)) sum_m += plant->width_m;
  EXPECT_NEAR(world.mean_obstacle_width_m, sum_m / static_cast<double>(plants(world).size()),
              1e-12);
}

TEST(Forest, IsSparserWhereTheRadiusIsLarger) {
  std::size_t before = 100000;
  for (const double radius_m : {2.3, 3.0, 4.0, 5.8}) {
    ForestSpec spec;
    spec.poisson_radius_m = radius_m;
    const std::size_t count = plants(make_world(spec, 12)).size();
    EXPECT_LT(count, before);
    before = count;
  }
}

/// Trees per square metre of two forests that YOPO (Lu et al., RA-L 2024) names, and the radii that
/// give them: 0.71/r² where discs are thrown until none has room.
TEST(Forest, HasTheDensityOfTreesThatItsRadiusSays) {
  for (const auto& [radius_m, density_1pm2] : {std::pair{3.77, 1.0 / 20}, {4.62, 1.0 / 30}}) {
    ForestSpec spec;
    spec.area_m = {100.0, 100.0};
    spec.poisson_radius_m = radius_m;
    spec.bush_ratio = 0.0;
    const double trees = static_cast<double>(plants(make_world(spec, 14)).size());
    std::printf("radius %.2f m: one tree on %.1f m^2\n", radius_m, 1e4 / trees);
    EXPECT_NEAR(trees / 1e4 / density_1pm2, 1.0, 0.05) << radius_m;
  }
}

TEST(Forest, LargeMapSharesItsPrototypes) {
  ForestSpec spec;
  spec.area_m = {160.0, 160.0};
  spec.poisson_radius_m = 2.3;
  const World world = make_world(spec, 13);
  EXPECT_GT(plants(world).size(), 3000U);
  EXPECT_LT(memory_bytes(world), 20'000'000U);
}

}  // namespace
}  // namespace avoidbench
