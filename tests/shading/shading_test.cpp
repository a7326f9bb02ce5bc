#include "shading/shading.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/digest.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

std::vector<std::uint8_t> shaded(const World& world, const Pinhole& camera, const Pose& pose,
                                 const Light& light = {}, int samples = 1,
                                 std::size_t flatten = 1000000) {
  const Scene scene(world, flatten);
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(camera.width_px * camera.height_px));
  render_shaded(scene, camera, pose, light, samples, rgb);
  return rgb;
}

double mean(const std::vector<std::uint8_t>& rgb) {
  return std::accumulate(rgb.begin(), rgb.end(), 0.0) / static_cast<double>(rgb.size());
}

double brightness(const std::vector<std::uint8_t>& rgb, const Pinhole& camera, int x, int y) {
  const auto i = 3 * static_cast<std::size_t>(y * camera.width_px + x);
  return (rgb[i] + rgb[i + 1] + rgb[i + 2]) / 3.0;
}

double variance(const std::vector<std::uint8_t>& rgb) {
  const double middle = mean(rgb);
  double sum = 0.0;
  for (const std::uint8_t level : rgb) sum += (level - middle) * (level - middle);
  return sum / static_cast<double>(rgb.size());
}

TEST(Shading, IsTheSameBitsEachTime) {
  const World world = test::scattered_world(21);
  const Pinhole camera = make_pinhole(61, 43, 1.4, 1000.0);
  const Pose pose = test::looking({-9.0, 0.0, 1.0}, {1.0, 0.0, -0.1});
  EXPECT_EQ(shaded(world, camera, pose, {}, 2), shaded(world, camera, pose, {}, 2));
}

// Pictures are kept beside results, and compared. Where the light is meant to change, so is this.
TEST(Shading, APictureIsThatOfEveryMachine) {
  const World world = test::scattered_world(21);
  const Pinhole camera = make_pinhole(61, 43, 1.4, 1000.0);
  const auto rgb = shaded(world, camera, test::looking({-9.0, 0.0, 1.0}, {1.0, 0.0, -0.1}));
  EXPECT_EQ(Digest().add_array(std::span(std::as_const(rgb))).hex().substr(0, 16),
            "2d17bf8afa30b89b");
}

TEST(Shading, BrighterLightIsNeverDarker) {
  const World world = test::scattered_world(21);
  const Pinhole camera = make_pinhole(31, 23, 1.4, 1000.0);
  const Pose pose = test::looking({-9.0, 0.0, 1.0}, {1.0, 0.0, -0.1});
  std::vector<std::uint8_t> dimmer = shaded(world, camera, pose, {.sun = 0.2});
  for (const double sun : {0.6, 1.0, 2.0, 6.0, 30.0}) {
    const std::vector<std::uint8_t> brighter = shaded(world, camera, pose, {.sun = sun});
    for (std::size_t i = 0; i < brighter.size(); ++i) ASSERT_GE(brighter[i], dimmer[i]) << sun;
    dimmer = brighter;
  }
}

TEST(Shading, SkyIsBlueAboveAndPaleAtTheHorizon) {
  const World world;
  const Pinhole camera = make_pinhole(9, 9, 0.2, 1000.0);
  const Light light{.to_sun_world = Vector3d(0.0, -1.0, 0.2)};
  const auto above =
      shaded(world, camera, test::looking(Vector3d::Zero(), Vector3d::UnitZ()), light);
  const auto ahead =
      shaded(world, camera, test::looking(Vector3d::Zero(), Vector3d::UnitX()), light);
  EXPECT_GT(above[2], above[0] + 40);
  EXPECT_GT(mean(ahead), mean(above));
}

TEST(Shading, ThingsCastShadowsFromTheSun) {
  // A plate 2 m above the floor; the sun stands in the zenith, so its shadow lies right below.
  World world = test::world_of(test::plane_mesh(50.0F));
  world.prototypes.push_back(test::make_prototype(test::plane_mesh(1.0F)));
  Eigen::Affine3f raised = Eigen::Affine3f::Identity();
  raised.translation() = Eigen::Vector3f(6.0F, 0.0F, 2.0F);
  test::place(world, 1, raised);
  const Pinhole camera = make_pinhole(41, 41, 0.6, 1000.0);
  Light light{.to_sun_world = Vector3d::UnitZ()};
  const Pose pose = test::looking({0.0, 0.0, 1.0}, {6.0, 0.0, -1.0});
  const auto with = shaded(world, camera, pose, light);
  light.shadows = false;
  const auto without = shaded(world, camera, pose, light);
  EXPECT_LT(brightness(with, camera, 20, 20), brightness(without, camera, 20, 20) - 20.0);
  EXPECT_EQ(brightness(with, camera, 0, 20), brightness(without, camera, 0, 20));
}

TEST(Shading, TheSunShinesThroughACeiling) {
  World world = test::world_of(test::plane_mesh(50.0F));
  Eigen::Affine3f raised = Eigen::Affine3f::Identity();
  raised.translation().z() = 5.0F;
  test::place(world, 0, raised, "ceiling");
  const Pinhole camera = make_pinhole(21, 21, 0.6, 1000.0);
  const Pose pose = test::looking({0.0, 0.0, 2.0}, {1.0, 0.0, -1.0});
  EXPECT_EQ(shaded(world, camera, pose), shaded(world, camera, pose, Light{.shadows = false}));
}

TEST(Shading, HazeTakesDistantColours) {
  World world = test::world_of(test::plane_mesh(5000.0F));
  const Pinhole camera = make_pinhole(21, 21, 0.1, 1e5);
  const Pose pose = test::looking({0.0, 0.0, 50.0}, {1.0, 0.0, -0.05});
  const auto hazy = shaded(world, camera, pose, Light{.haze_range_m = 50.0});
  const Pose ahead = test::looking({0.0, 0.0, 50.0}, {1.0, 0.0, 0.0});
  const auto sky = shaded(World{}, camera, ahead, Light{.to_sun_world = -Vector3d::UnitX()});
  EXPECT_NEAR(brightness(hazy, camera, 10, 10), brightness(sky, camera, 10, 5), 12.0);
}

TEST(Shading, EveryMaterialHasATextureAndOpacityTakesItAway) {
  const Pinhole camera = make_pinhole(64, 64, 1.2, 100.0);
  const Pose pose = test::looking({0.0, 0.0, 1.0}, -Vector3d::UnitZ());
  for (const Material material : {Material::soil, Material::bark, Material::leaf, Material::brick,
                                  Material::concrete, Material::painted_metal}) {
    World world = test::world_of(test::plane_mesh(10.0F));
    std::fill(world.prototypes[0].triangle_materials.begin(),
              world.prototypes[0].triangle_materials.end(), material);
    const double textured = variance(shaded(world, camera, pose));
    world.obstacles[0].texture_opacity = 0.0;
    const auto bland = shaded(world, camera, pose);
    std::array<double, 3> channel{};
    for (std::size_t i = 0; i < bland.size(); ++i) {
      channel[i % 3] = std::max(channel[i % 3], std::abs(bland[i] - bland[i % 3] + 0.0));
    }
    for (const double spread : channel) EXPECT_LE(spread, 3.0) << static_cast<int>(material);
    EXPECT_GT(textured, variance(bland) + 50.0) << static_cast<int>(material);
  }
}

TEST(Shading, TexturesAreFixedToTheObject) {
  // The same turn and shift of object, camera and sun: the same picture, but for a few rounded
  // levels.
  World world;
  world.prototypes.push_back(
      test::make_prototype(test::box_mesh({2.0F, 2.0F, 2.0F}), Material::bark));
  test::place(world, 0, Eigen::Affine3f::Identity());
  World moved = world;
  const Eigen::Quaternionf quarter(Eigen::Matrix3f{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}});
  Eigen::Affine3f T = Eigen::Affine3f::Identity();
  T.linear() = quarter.toRotationMatrix();
  T.translation() = Eigen::Vector3f(32.0F, 8.0F, 0.0F);
  moved.instances[0].T_world_prototype = T;
  Pose T_moved = Pose::Identity();
  T_moved.linear() = T.linear().cast<double>();
  T_moved.translation() = T.translation().cast<double>();
  const Pinhole camera = make_pinhole(48, 48, 0.8, 100.0);
  const Pose pose = test::looking({-4.0, 1.0, 1.5}, {4.0, -1.0, -1.5});
  Light light;
  const auto here = shaded(world, camera, pose, light);
  light.to_sun_world = T_moved.linear() * light.to_sun_world;
  const auto there = shaded(moved, camera, T_moved * pose, light);
  int different = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (std::abs(here[i] - there[i]) > 8) ++different;
  }
  EXPECT_LT(different, 100);
  EXPECT_GT(variance(here), 100.0);
}

TEST(Shading, SamplesSmoothEdges) {
  const World world = test::scattered_world(22);
  const Pinhole camera = make_pinhole(40, 30, 1.4, 1000.0);
  const Pose pose = test::looking({-9.0, 0.0, 1.0}, {1.0, 0.0, -0.1});
  const auto rough = shaded(world, camera, pose, {}, 1);
  const auto smooth = shaded(world, camera, pose, {}, 4);
  EXPECT_NEAR(mean(rough), mean(smooth), 4.0);
  double rough_steps = 0.0;
  double smooth_steps = 0.0;
  for (std::size_t i = 3; i < rough.size(); ++i) {
    rough_steps += (rough[i] - rough[i - 3]) * (rough[i] - rough[i - 3]);
    smooth_steps += (smooth[i] - smooth[i - 3]) * (smooth[i] - smooth[i - 3]);
  }
  EXPECT_LT(smooth_steps, rough_steps);
}

TEST(Shading, InstancedAndFlattenedLookTheSame) {
  const World world = test::scattered_world(23);
  const Pinhole camera = make_pinhole(80, 60, 1.4, 1000.0);
  const Pose pose = test::looking({-9.0, 0.0, 1.0}, {1.0, 0.0, -0.1});
  const auto flattened = shaded(world, camera, pose, {}, 1);
  const auto instanced = shaded(world, camera, pose, {}, 1, 0);
  int different = 0;
  for (std::size_t i = 0; i < flattened.size(); ++i) {
    if (std::abs(flattened[i] - instanced[i]) > 6) ++different;
  }
  EXPECT_LT(different, static_cast<int>(flattened.size()) / 100);
}

}  // namespace
}  // namespace avoidbench
