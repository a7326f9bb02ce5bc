#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/input_error.hpp"
#include "maps/generators.hpp"

namespace avoidbench {
namespace {

std::map<std::string, int> counts(const World& world) {
  std::map<std::string, int> counts;
  for (const Obstacle& obstacle : world.obstacles) ++counts[obstacle.kind];
  return counts;
}

std::string problem_of(const MapSpec& spec) {
  try {
    check_map(spec);
  } catch (const InputError& error) {
    std::string all;
    for (const InputProblem& problem : error.problems()) all += problem.message + '\n';
    return all;
  }
  return {};
}

TEST(AvoidbenchForest, HasThePlantsWithinTwentyMetresOfTheFlightSpace) {
  const AvoidbenchForestSpec spec;
  const World world = make_world(spec, 1);
  std::vector<Eigen::Vector2d> expected;
  for (const Eigen::Vector2f& place : make_avoidbench_field(field_suite(spec), 1).positions_m) {
    const Eigen::Vector2d foot = place.cast<double>() - Eigen::Vector2d(50.0, 60.0);
    if (foot.minCoeff() >= -20.0 && foot.maxCoeff() <= 60.0) expected.push_back(foot);
  }
  ASSERT_EQ(world.obstacles.size(), expected.size() + 1);
  EXPECT_EQ(world.obstacles[0].kind, "ground");
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Eigen::Vector3d& foot = world.obstacles[i + 1].position_world;
    EXPECT_EQ(foot.head<2>(), expected[i]);
    EXPECT_EQ(foot.z(), ground_height_m(world, foot.x(), foot.y()));
  }
  EXPECT_NEAR(world.poisson_radius_m, 3.268, 1e-6);
  EXPECT_GT(world.mean_obstacle_width_m, 0.1);
}

TEST(AvoidbenchForest, BandsAndBoundsAreThoseOfTheOriginal) {
  const World world = make_world(AvoidbenchForestSpec{}, 2);
  EXPECT_EQ(world.start_region.lowest, Eigen::Vector3d(0.0, 0.0, 2.0));
  EXPECT_EQ(world.start_region.highest, Eigen::Vector3d(40.0, 6.0, 2.0));
  EXPECT_EQ(world.goal_region.lowest, Eigen::Vector3d(0.0, 28.0, 2.0));
  EXPECT_EQ(world.goal_region.highest, Eigen::Vector3d(40.0, 34.0, 3.0));
  EXPECT_EQ(world.flight_bounds.max(), Eigen::Vector3d(40.0, 40.0, 6.4));
  EXPECT_TRUE(world.bounds.contains(world.flight_bounds));
  EXPECT_TRUE(world.heights_above_ground);
}

TEST(AvoidbenchForest, APlantStaysWhatItIsWhereTheFlightSpaceMoves) {
  AvoidbenchForestSpec here, there;
  there.range_origin_m = {55.0, 62.0};
  const World a = make_world(here, 3);
  const World b = make_world(there, 3);
  std::size_t same = 0;
  for (const Obstacle& one : a.obstacles) {
    for (const Obstacle& other : b.obstacles) {
      const Eigen::Vector2d apart =
          (one.position_world - other.position_world).head<2>() - Eigen::Vector2d(5.0, 2.0);
      if (one.kind == "ground" || apart.norm() > 1e-9) continue;
      EXPECT_EQ(one.kind, other.kind);
      EXPECT_EQ(one.width_m, other.width_m);
      ++same;
    }
  }
  EXPECT_GT(same, a.obstacles.size() * 3 / 4);
}

TEST(AvoidbenchForest, AboutTwoFifthsAreBushes) {
  const std::map<std::string, int> kinds = counts(make_world(AvoidbenchForestSpec{}, 4));
  const double bushes = kinds.at("bush");
  EXPECT_NEAR(bushes / (bushes + kinds.at("tree")), 0.4, 0.05);
}

TEST(AvoidbenchIndoor, CylindersAreTheOriginals) {
  const AvoidbenchIndoorSpec spec;
  const World world = make_world(spec, 3);
  const auto field = make_avoidbench_field(field_suite(spec), 3);
  const auto ratios = avoidbench_size_ratios(field.map_seed, field.positions_m.size());
  ASSERT_EQ(counts(world)["cylinder"], 49);
  std::size_t i = 0;
  for (const Instance& instance : world.instances) {
    const Obstacle& obstacle = world.obstacles[instance.obstacle];
    if (obstacle.kind != "cylinder") continue;
    EXPECT_EQ(obstacle.position_world.x(), static_cast<double>(field.positions_m[i].x()));
    EXPECT_EQ(obstacle.position_world.y(), static_cast<double>(field.positions_m[i].y()) + 0.8);
    EXPECT_DOUBLE_EQ(obstacle.width_m, 0.5 + 0.5 * ratios[i]);
    double top_m = 0.0;
    for (const Eigen::Vector3f& vertex : world.prototypes[instance.prototype].mesh.vertices) {
      top_m = std::max(top_m, static_cast<double>(vertex.z()));
    }
    EXPECT_NEAR(top_m, 5.2 + 2.4 * ratios[i], 1e-6);
    ++i;
  }
}

TEST(AvoidbenchIndoor, HallEndsBehindTheCylinders) {
  const World world = make_world(AvoidbenchIndoorSpec{}, 1);
  EXPECT_EQ(counts(world)["wall"], 4);
  EXPECT_EQ(world.flight_bounds.max(), Eigen::Vector3d(20.0, 30.0, 4.0));
  EXPECT_TRUE(world.bounds.min().isApprox(Eigen::Vector3d(0.0, -2.0, 0.0)));
  EXPECT_TRUE(world.bounds.max().isApprox(Eigen::Vector3d(20.0, 32.8, 4.0)));
  EXPECT_EQ(world.start_region.lowest, Eigen::Vector3d(2.0, 0.0, 2.0));
  EXPECT_EQ(world.start_region.highest, Eigen::Vector3d(18.0, 1.6, 2.0));
  EXPECT_EQ(world.goal_region.lowest, Eigen::Vector3d(2.0, 26.4, 2.0));
  EXPECT_EQ(world.goal_region.highest, Eigen::Vector3d(18.0, 28.0, 3.0));
}

TEST(AvoidbenchIndoor, TextureOpacityMovesNoCylinder) {
  AvoidbenchIndoorSpec bold, bland;
  bland.texture_opacity = 0.25;
  const World a = make_world(bold, 2);
  const World b = make_world(bland, 2);
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].position_world, b.obstacles[i].position_world);
    EXPECT_EQ(a.obstacles[i].width_m, b.obstacles[i].width_m);
  }
  EXPECT_NE(a.digest, b.digest);
}

TEST(AvoidbenchWorlds, ContradictionsAreTheUsersErrors) {
  EXPECT_EQ(problem_of(AvoidbenchForestSpec{}), "");
  EXPECT_EQ(problem_of(AvoidbenchIndoorSpec{}), "");
  AvoidbenchForestSpec forest;
  forest.range_origin_m = {150.0, 60.0};
  forest.start_height_m = 6.0;
  forest.goal_band_m = {30.0, 28.0};
  const std::string problems = problem_of(forest);
  EXPECT_NE(problems.find("range_origin_m: the flight space is outside"), std::string::npos);
  EXPECT_NE(problems.find("start_height_m: 6 is not below"), std::string::npos);
  EXPECT_NE(problems.find("goal_band_m: the least is above"), std::string::npos);
  AvoidbenchIndoorSpec indoor;
  indoor.ceiling_m = 7.0;
  indoor.band_width_m = 21.0;
  indoor.suite_seed = -1;
  const std::string others = problem_of(indoor);
  EXPECT_NE(others.find("cylinder_height_m: 7.6 is not below ceiling_m, 7"), std::string::npos);
  EXPECT_NE(others.find("band_width_m: wider"), std::string::npos);
  EXPECT_NE(others.find("suite_seed: -1 is outside"), std::string::npos);
}

}  // namespace
}  // namespace avoidbench
