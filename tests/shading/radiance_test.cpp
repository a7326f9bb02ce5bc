#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/digest.hpp"
#include "maps/map_spec.hpp"
#include "render/depth.hpp"
#include "render/ray_tracing_isa.hpp"
#include "shading/shading.hpp"
#include "shading/shading_kernel.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<float> radiance(const Scene& scene, const Pinhole& camera, const Pose& pose,
                            const Light& light = {}, Channels channels = Channels::grey,
                            int samples = 1) {
  std::vector<float> image(static_cast<std::size_t>(camera.width_px) *
                           static_cast<std::size_t>(camera.height_px) *
                           static_cast<std::size_t>(channels));
  render_radiance(scene, camera, pose, light, samples, channels, image);
  return image;
}

double mean(const std::vector<float>& image) {
  double sum = 0.0;
  for (const float light : image) sum += static_cast<double>(light);
  return sum / static_cast<double>(image.size());
}

double variance(const std::vector<float>& image) {
  const double middle = mean(image);
  double sum = 0.0;
  for (const float light : image) {
    sum += (static_cast<double>(light) - middle) * (static_cast<double>(light) - middle);
  }
  return sum / static_cast<double>(image.size());
}

World small_hall() { return make_world(HallSpec{.area_m = {20.0, 20.0}}, 3); }
World small_forest() { return make_world(ForestSpec{.area_m = {20.0, 20.0}}, 3); }

Pose in_the_middle(const World& world, const Vector3d& forward = {0.3, 1.0, 0.0}) {
  if (world.flight_bounds.isEmpty()) return test::looking({-9.0, 0.0, 1.0}, forward);
  const double x = world.flight_bounds.center().x();
  const double y = world.flight_bounds.min().y() + 1.0;
  return test::looking({x, y, ground_height_m(world, x, y) + 1.7}, forward);
}

/// A plane of this material across the line of sight, whose lit side the camera looks at.
World wall(Material material, double opacity) {
  World world;
  world.prototypes.push_back(test::make_prototype(test::plane_mesh(60.0F), material));
  Eigen::Affine3f moved = Eigen::Affine3f::Identity();
  moved.translation() = Eigen::Vector3f(1.3F, 0.7F, 0.0F);
  test::place(world, 0, moved);
  world.obstacles[0].texture_opacity = opacity;
  return world;
}

Pose facing_wall(double distance_m) {
  return test::looking({3.0, 2.0, distance_m}, -Vector3d::UnitZ());
}

constexpr Material kTextured[] = {Material::soil,  Material::bark,     Material::leaf,
                                  Material::brick, Material::concrete, Material::painted_metal};

void expect_same_bits_of_both_kernels(const World& world) {
  const Scene flattened(world);
  const Scene instanced(world, 0);
  const Pinhole camera = make_pinhole(161, 119, 1.5, kInfinity);
  for (const Scene* scene : {&flattened, &instanced}) {
    for (const bool has_shadows : {false, true}) {
      for (const Vector3d& forward : {Vector3d(0.3, 1.0, 0.0), Vector3d(0.1, 0.5, -0.6)}) {
        const Pose pose = in_the_middle(world, forward);
        const Light light{.shadows = has_shadows};
        std::vector<float> portable(std::size_t{3} * 161 * 119);
        std::vector<float> avx2(portable.size());
        render_radiance_by(kPortableShading, *scene, camera, pose, light, 1, Channels::rgb,
                           portable);
        render_radiance_by(kAvx2Shading, *scene, camera, pose, light, 1, Channels::rgb, avx2);
        EXPECT_EQ(std::memcmp(portable.data(), avx2.data(), portable.size() * sizeof(float)), 0);
        for (const float value : avx2) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
      }
    }
  }
}

TEST(Radiance, BothKernelsGiveTheSameBits) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
  EXPECT_EQ(&shading_kernel(), &kAvx2Shading);
  expect_same_bits_of_both_kernels(small_hall());
  expect_same_bits_of_both_kernels(small_forest());
  expect_same_bits_of_both_kernels(test::scattered_world(31));
}

// What stereo matches: other textures are other results (golden tables follow).
TEST(Radiance, TexturesAreThoseOfEveryMachine) {
  std::string digests;
  for (const Material material : kTextured) {
    const World world = wall(material, 1.0);
    const Scene scene(world);
    const auto image =
        radiance(scene, make_pinhole(31, 23, 1.2, kInfinity), facing_wall(3.0), {}, Channels::rgb);
    digests += Digest().add_array(std::span(image)).hex().substr(0, 8) + ' ';
  }
  EXPECT_EQ(digests, "e418f3b4 147393f3 771be379 40a78452 586a0ba4 bc9d3bc4 ");
}

TEST(Radiance, GreyIsTheLuminance) {
  const World world = small_forest();
  const Scene scene(world);
  const Pinhole camera = make_pinhole(83, 61, 1.5, kInfinity);
  const Pose pose = in_the_middle(world);
  const auto grey = radiance(scene, camera, pose);
  const auto rgb = radiance(scene, camera, pose, {}, Channels::rgb);
  ASSERT_EQ(grey.size(), 83U * 61U);
  ASSERT_EQ(rgb.size(), 3 * grey.size());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const float* c = &rgb[3 * i];
    EXPECT_NEAR(grey[i], 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2], 1e-6F * (1 + grey[i]));
  }
}

TEST(Radiance, AGreyCardInTheSunIsInTheMiddleOfTheScale) {
  const World world = wall(Material::concrete, 0.0);  // its bland albedo is 0.25
  const Scene scene(world);
  const auto image = radiance(scene, make_pinhole(16, 12, 1.0, kInfinity), facing_wall(2.0));
  EXPECT_GT(mean(image), 0.2);
  EXPECT_LT(mean(image), 0.6);
}

TEST(Radiance, VarianceRisesWithTheOpacityOfTheTexture) {
  const Pinhole camera = make_pinhole(96, 72, 1.2, kInfinity);
  const Light light{.haze_range_m = kInfinity};
  for (const Material material : kTextured) {
    std::vector<double> variances;
    for (const double opacity : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const World world = wall(material, opacity);
      const Scene scene(world);
      variances.push_back(variance(radiance(scene, camera, facing_wall(2.0), light)));
    }
    EXPECT_LT(variances.front(), 1e-6 * variances.back()) << static_cast<int>(material);
    EXPECT_TRUE(std::is_sorted(variances.begin(), variances.end())) << static_cast<int>(material);
  }
}

/// Mean over windows of 9 × 9 pixels, about what a matcher compares: deviation by mean.
double window_contrast(const std::vector<float>& image, int width, int height) {
  double sum = 0.0;
  int windows = 0;
  for (int y = 0; y + 9 <= height; y += 9) {
    for (int x = 0; x + 9 <= width; x += 9, ++windows) {
      std::vector<float> window;
      for (int row = y; row < y + 9; ++row) {
        const auto from = image.begin() + row * width + x;
        window.insert(window.end(), from, from + 9);
      }
      sum += std::sqrt(variance(window)) / mean(window);
    }
  }
  return sum / windows;
}

TEST(Radiance, EveryMaterialHasContrastNearAndFar) {
  const Pinhole camera = make_pinhole(320, 240, 1.5708, kInfinity);
  for (const Material material : kTextured) {
    const World world = wall(material, 1.0);
    const Scene scene(world);
    for (const double distance_m : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0}) {
      const auto image = radiance(scene, camera, facing_wall(distance_m));
      EXPECT_GT(window_contrast(image, 320, 240), 0.045)
          << static_cast<int>(material) << " at " << distance_m << " m";
    }
  }
}

TEST(Radiance, DetailFinerThanAPixelFadesInsteadOfAliasing) {
  // A band-limited texture has about the mean of its neighbours halfway between them; white noise
  // would differ from it by one standard deviation.
  const Pinhole camera = make_pinhole(160, 120, 1.5708, kInfinity);
  Pinhole shifted = camera;
  shifted.cx_px += 0.5;
  for (const Material material : kTextured) {
    const World world = wall(material, 1.0);
    const Scene scene(world);
    const auto here = radiance(scene, camera, facing_wall(20.0));
    const auto there = radiance(scene, shifted, facing_wall(20.0));  // pixel x sees x − 1/2
    double difference = 0.0;
    int count = 0;
    for (std::size_t i = 1; i < here.size(); ++i) {
      if (i % 160 == 0) continue;
      difference += std::abs(static_cast<double>(0.5F * (here[i - 1] + here[i]) - there[i]));
      ++count;
    }
    EXPECT_LT(difference / count, 0.2 * std::sqrt(variance(here))) << static_cast<int>(material);
  }
}

struct Match {
  double difference = 0.0;  ///< mean absolute, of the left image and the right one warped to it
  double unmatched = 0.0;   ///< the same, unwarped
  double deviation = 0.0;   ///< standard, of the left image
  int count = 0;
};

/// Compares the right image's pixels with those of the left image that see the same point.
Match match_stereo(const World& world, const Light& light) {
  constexpr double kBaseline_m = 0.1;
  const Scene scene(world);
  const Pinhole camera = make_pinhole(320, 240, 1.5708, 1000.0);
  const Pose left_pose = in_the_middle(world);
  Pose right_pose = left_pose;
  right_pose.translation() += kBaseline_m * left_pose.linear().col(0);
  const auto left = radiance(scene, camera, left_pose, light);
  const auto right = radiance(scene, camera, right_pose, light);
  std::vector<float> left_depth(left.size());
  std::vector<float> right_depth(left.size());
  render_depth(scene, camera, left_pose, left_depth);
  render_depth(scene, camera, right_pose, right_depth);
  Match match;
  for (std::size_t y = 0; y < 240; ++y) {
    for (std::size_t x = 0; x < 320; ++x) {
      const auto i = 320 * y + x;
      const double disparity_px = camera.fx_px * kBaseline_m / static_cast<double>(right_depth[i]);
      const double x_left = static_cast<double>(x) + disparity_px;
      if (!(x_left < 319.0)) continue;
      const auto low = static_cast<std::size_t>(x_left);
      const auto j = 320 * y + low;
      const auto is_same = [&](std::size_t k) {
        return std::abs(left_depth[k] - right_depth[i]) < 0.02F * right_depth[i];
      };
      if (!is_same(j) || !is_same(j + 1)) continue;  // hidden from the left, or an edge
      const auto t = static_cast<float>(x_left - static_cast<double>(low));
      match.difference +=
          static_cast<double>(std::abs(left[j] + t * (left[j + 1] - left[j]) - right[i]));
      match.unmatched += static_cast<double>(std::abs(left[i] - right[i]));
      ++match.count;
    }
  }
  match.difference /= match.count;
  match.unmatched /= match.count;
  match.deviation = std::sqrt(variance(left));
  return match;
}

TEST(Radiance, TwoCamerasSeeTheSameTexture) {
  const Match hall = match_stereo(small_hall(), Light{.shadows = false});
  EXPECT_GT(hall.count, 50000);
  EXPECT_LT(hall.difference, 0.04 * hall.deviation) << hall.unmatched / hall.deviation;
  EXPECT_LT(hall.difference, 0.2 * hall.unmatched);
  const Match forest = match_stereo(small_forest(), Light{.shadows = false});
  EXPECT_GT(forest.count, 20000);
  EXPECT_LT(forest.difference, 0.06 * forest.deviation) << forest.unmatched / forest.deviation;
  RecordProperty("hall", std::to_string(hall.difference / hall.deviation));
  RecordProperty("forest", std::to_string(forest.difference / forest.deviation));
}

TEST(Radiance, ABoxCastsAShadow) {
  World world = test::world_of(test::plane_mesh(50.0F));
  world.prototypes.push_back(test::make_prototype(test::box_mesh({2.0F, 2.0F, 2.0F})));
  Eigen::Affine3f raised = Eigen::Affine3f::Identity();
  raised.translation() = Eigen::Vector3f(6.0F, 0.0F, 3.0F);
  test::place(world, 1, raised);
  world.obstacles[0].texture_opacity = 0.0;
  const Scene scene(world);
  const Pinhole camera = make_pinhole(41, 41, 0.6, kInfinity);
  Light light{.to_sun_world = Vector3d::UnitZ()};
  const Pose pose = test::looking({0.0, 0.0, 1.0}, {6.0, 0.0, -1.0});
  const auto with = radiance(scene, camera, pose, light);
  light.shadows = false;
  const auto without = radiance(scene, camera, pose, light);
  const std::size_t below_box = 41 * 20 + 20;
  EXPECT_LT(with[below_box], 0.6F * without[below_box]);
  EXPECT_EQ(with[41 * 20], without[41 * 20]);
}

TEST(Radiance, SurfacesHideTheSkyOnlyWithinTheCamerasRange) {
  const World world = wall(Material::brick, 1.0);
  const Scene scene(world);
  const Light light{.haze_range_m = kInfinity};
  Pinhole camera = make_pinhole(32, 24, 1.0, 30.0);
  const Pose pose = facing_wall(20.0);
  const auto near = radiance(scene, camera, pose, light);
  camera.max_range_m = kInfinity;
  EXPECT_EQ(near, radiance(scene, camera, pose, light));
  camera.max_range_m = 10.0;
  const World nothing;
  EXPECT_EQ(radiance(scene, camera, pose, light), radiance(Scene(nothing), camera, pose, light));
}

TEST(Radiance, DoesNotDependOnDenormalFlagsAndLeavesThem) {
  const World world = small_hall();
  const Scene scene(world);
  const Pinhole camera = make_pinhole(80, 60, 1.5, kInfinity);
  const Pose pose = in_the_middle(world);
  const unsigned before = _mm_getcsr();
  const auto image = radiance(scene, camera, pose);
  EXPECT_EQ(_mm_getcsr() & 0xffc0U, before & 0xffc0U);
  constexpr unsigned kFlushToZeroAndDenormalsAreZero = 0x8040U;
  _mm_setcsr(before | kFlushToZeroAndDenormalsAreZero);
  const auto flushed = radiance(scene, camera, pose);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(before);
  EXPECT_EQ(after & 0xffc0U, (before | kFlushToZeroAndDenormalsAreZero) & 0xffc0U);
  EXPECT_EQ(image, flushed);
}

TEST(Radiance, SamplesAverageLinearLight) {
  const World world = small_forest();
  const Scene scene(world);
  const Pinhole camera = make_pinhole(50, 30, 1.5, kInfinity);
  Pinhole finer = camera;
  finer.width_px *= 2;
  finer.height_px *= 2;
  finer.fx_px *= 2.0;
  finer.fy_px *= 2.0;
  finer.cx_px = 2.0 * camera.cx_px + 0.5;
  finer.cy_px = 2.0 * camera.cy_px + 0.5;
  const Pose pose = in_the_middle(world);
  const auto averaged = radiance(scene, camera, pose, {}, Channels::grey, 2);
  const auto fine = radiance(scene, finer, pose);
  for (std::size_t y = 0; y < 30; ++y) {
    for (std::size_t x = 0; x < 50; ++x) {
      const float* first = &fine[200 * y + 2 * x];
      const float expected = 0.25F * (first[0] + first[1] + first[100] + first[101]);
      EXPECT_NEAR(averaged[50 * y + x], expected, 1e-4F);
    }
  }
}

}  // namespace
}  // namespace avoidbench
