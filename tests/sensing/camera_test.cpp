#include "sensing/camera.hpp"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "maps/map_spec.hpp"
#include "render/depth.hpp"
#include "sensing/depth_statistics.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr ImageNeeds kAll{.depth = true, .stereo = true, .color = true};

SensorSpec preset(const std::string& name) {
  for (const SensorSpec& sensor : sensor_presets()) {
    if (sensor.name == name) return sensor;
  }
  ADD_FAILURE() << "no sensor " << name;
  return {};
}

/// A wall of concrete in the plane z = 0.
World wall(double opacity = 1.0) {
  World world;
  world.prototypes.push_back(test::make_prototype(test::plane_mesh(60.0F), Material::concrete));
  test::place(world, 0, Eigen::Affine3f::Identity());
  world.obstacles[0].texture_opacity = opacity;
  return world;
}

/// Looks at the wall from `distance_m`, turned away from facing it by `tilt_deg`.
Pose facing_wall(double distance_m, double tilt_deg = 0.0) {
  const double tilt = tilt_deg * math::kDegree;
  return test::looking({0.3, 0.2, distance_m}, {math::sin(tilt), 0.01, -math::cos(tilt)});
}

std::vector<float> true_depth(const SensorSpec& sensor, const Scene& scene, const Pose& pose) {
  Pinhole ideal = sensor_camera(sensor);
  ideal.min_range_m = 0.0;
  ideal.max_range_m = std::numeric_limits<double>::infinity();
  std::vector<float> depth_m(static_cast<std::size_t>(sensor.width_px * sensor.height_px));
  render_depth(scene, ideal, pose, depth_m);
  return depth_m;
}

CameraImages seen(const SensorSpec& sensor, const Scene& scene, const Pose& pose,
                  const ImageNeeds& needs = kAll, std::uint64_t seed = 1,
                  const CameraMotion& motion = {}) {
  Camera camera(sensor);
  CameraImages images;
  camera.expose(scene, pose, motion, needs, seed, images);
  return images;
}

/// Root mean square of the disparity errors, away from the image's edges.
double disparity_rms_px(const SensorSpec& sensor, const Scene& scene, const Pose& pose) {
  const CameraImages images = seen(sensor, scene, pose);
  const std::vector<float> truth = true_depth(sensor, scene, pose);
  const auto at_1m = static_cast<float>(disparity_at_1m_px(sensor));
  double squares = 0.0, count = 0.0;
  for (std::int64_t y = 10; y < sensor.height_px - 10; ++y) {
    for (std::int64_t x = 40; x < sensor.width_px - 10; ++x) {
      const auto i = static_cast<std::size_t>(y * sensor.width_px + x);
      const double error = static_cast<double>(images.disparity_px[i] - at_1m / truth[i]);
      if (std::isnan(error)) continue;
      squares += error * error;
      count += 1.0;
    }
  }
  EXPECT_GT(count, 0.95 * static_cast<double>((sensor.width_px - 50) * (sensor.height_px - 20)));
  return std::sqrt(squares / count);
}

TEST(Camera, SubpixelDisparityOfATiltedPlaneIsRightWithinAQuarterPixel) {
  const World world = wall();
  const Scene scene(world);
  for (const double tilt_deg : {15.0, 30.0, 45.0}) {
    for (const double distance_m : {2.0, 4.0}) {
      const Pose pose = facing_wall(distance_m, tilt_deg);
      EXPECT_LT(disparity_rms_px(preset("stereo_sgm"), scene, pose), 0.25) << tilt_deg;
      SensorSpec census = preset("stereo_original");
      census.method = StereoSgmSpec{.subpixel = true};
      EXPECT_LT(disparity_rms_px(census, scene, pose), 0.25) << tilt_deg;
    }
  }
  // Where all disparities are equal, the matcher's bias toward whole and half ones shows.
  EXPECT_LT(disparity_rms_px(preset("stereo_sgm"), scene, facing_wall(2.0)), 0.35);
  // Whole pixels err by 1/√12 and a little.
  const double whole = disparity_rms_px(preset("stereo_original"), scene, facing_wall(3.0, 30.0));
  EXPECT_GT(whole, 0.25);
  EXPECT_LT(whole, 0.40);
}

TEST(Camera, DepthErrorGrowsWithTheSquareOfTheDistance) {
  const SensorSpec sensor = preset("stereo_sgm");
  const World world = wall();
  const Scene scene(world);
  double first = 0.0;
  for (const double distance_m : {2.0, 4.0, 8.0}) {
    std::vector<DepthSample> samples;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      Pose pose = facing_wall(distance_m, 25.0);
      pose.translation().x() += 0.37 * static_cast<double>(seed);
      const CameraImages images = seen(sensor, scene, pose, {.depth = true}, seed);
      add_samples(true_depth(sensor, scene, pose), images.depth_m, 320, disparity_at_1m_px(sensor),
                  8, samples);
    }
    const DepthStatistics statistics =
        depth_statistics(samples, false, 0.0, 1.3 * distance_m, disparity_at_1m_px(sensor));
    EXPECT_NEAR(statistics.depth_sigma_m / statistics.expected_depth_sigma_m, 1.0, 0.25);
    const double scaled = statistics.depth_sigma_m / (distance_m * distance_m);
    if (first == 0.0) first = scaled;
    EXPECT_NEAR(scaled / first, 1.0, 0.6) << distance_m;
  }
}

/// The law of Gallup et al. (CVPR 2008): depth errs by z²/(f b) of what disparity errs by. With one
/// deviation of disparity for all distances, the depth of a textured plane has that of the law at
/// each, and the exponent that fits is two.
TEST(Camera, DepthErrorIsTheLawsWithOneDeviationOfDisparity) {
  SensorSpec sensor = preset("stereo_sgm");
  // Four times the preset's disparity: each band of distances spans more than a whole pixel, over
  // which the matcher's bias toward whole and half ones averages out.
  sensor.width_px = 640;
  sensor.height_px = 480;
  sensor.baseline_m = 0.2;
  const double at_1m_px = disparity_at_1m_px(sensor);
  const World world = wall();
  const Scene scene(world);
  const std::vector<double> distances_m{2.0, 3.0, 4.0, 6.0, 8.0};
  std::vector<double> sigmas_m;
  double squares_px = 0.0;
  for (const double distance_m : distances_m) {
    std::vector<DepthSample> samples;
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      Pose pose = facing_wall(distance_m, 25.0);
      pose.translation().x() += 0.37 * static_cast<double>(seed);
      const CameraImages images = seen(sensor, scene, pose, {.depth = true}, seed);
      add_samples(true_depth(sensor, scene, pose), images.depth_m, 640, at_1m_px, 8, samples);
    }
    // Only what lies near this distance: the law is one of places, not of whole images.
    const DepthStatistics near =
        depth_statistics(samples, false, 0.9 * distance_m, 1.1 * distance_m, at_1m_px);
    EXPECT_GT(near.pixel_count, 10000U) << distance_m;
    sigmas_m.push_back(near.depth_sigma_m);
    squares_px += near.disparity_sigma_px * near.disparity_sigma_px;
  }
  const auto count = static_cast<double>(distances_m.size());
  const double sigma_px = std::sqrt(squares_px / count);
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < distances_m.size(); ++i) {
    const double law_m = distances_m[i] * distances_m[i] / at_1m_px * sigma_px;
    std::printf("%.0f m: %.4f m, law %.4f\n", distances_m[i], sigmas_m[i], law_m);
    EXPECT_NEAR(sigmas_m[i] / law_m, 1.0, 0.2) << distances_m[i];
    const double along = std::log(distances_m[i]), up = std::log(sigmas_m[i]);
    x += along;
    y += up;
    xx += along * along;
    xy += along * up;
  }
  const double exponent = (count * xy - x * y) / (count * xx - x * x);
  std::printf("disparity errs by %.3f px, exponent %.3f\n", sigma_px, exponent);
  EXPECT_NEAR(exponent, 2.0, 0.15);
}

TEST(Camera, LeftIsTheRightOneWarpedByTrueDisparity) {
  SensorSpec sensor = preset("stereo_sgm");
  sensor.image.full_well_e = 0.0;  // no noise
  sensor.image.vignetting = 0.0;
  const World world = make_world(HallSpec{.area_m = {20.0, 20.0}}, 3);
  const Scene scene(world);
  const Vector3d place = world.flight_bounds.center();
  const Pose pose = test::looking({place.x(), 1.0, 1.7}, {0.2, 1.0, 0.0});
  const CameraImages images = seen(sensor, scene, pose);
  const std::vector<float> truth = true_depth(sensor, scene, pose);
  const auto at_1m = static_cast<float>(disparity_at_1m_px(sensor));
  double difference = 0.0, contrast = 0.0, count = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::size_t x = i % 320;
    if (x < 24 || x > 316) continue;
    const float disparity = at_1m / truth[i];
    bool is_smooth = true;  // no step near, so that nothing is hidden
    for (std::size_t k = i - 24; k <= i + 3; ++k) {
      is_smooth = is_smooth && std::abs(at_1m / truth[k] - disparity) < 1.5F;
    }
    if (!is_smooth) continue;
    const float column = static_cast<float>(x) - disparity;
    const auto whole = static_cast<std::size_t>(column);
    const float part = column - static_cast<float>(whole);
    const std::uint8_t* row = &images.right[i - x];
    const double warped = static_cast<double>((1.0F - part) * static_cast<float>(row[whole]) +
                                              part * static_cast<float>(row[whole + 1]));
    difference += std::abs(warped - images.left[i]);
    contrast += std::abs(static_cast<double>(images.left[i]) - images.left[i - 5]);
    count += 1.0;
  }
  ASSERT_GT(count, 20000.0);
  EXPECT_LT(difference / count, 2.5);  // of 255
  EXPECT_LT(difference, 0.25 * contrast);
}

TEST(Camera, ImagesFollowFromTheSeedAlone) {
  const World world = make_world(HallSpec{.area_m = {20.0, 20.0}}, 3);
  const Scene scene(world);
  const Pose pose = test::looking({10.0, 1.0, 1.7}, {0.2, 1.0, 0.0});
  for (const SensorSpec& sensor : sensor_presets()) {
    const CameraImages fresh = seen(sensor, scene, pose, {.depth = true}, 5);
    Camera used(sensor);
    CameraImages images;
    used.expose(scene, test::looking({8.0, 5.0, 1.0}, {1.0, 0.0, 0.1}), {}, kAll, 6, images);
    used.expose(scene, pose, {}, kAll, 5, images);
    ASSERT_FALSE(fresh.depth_m.empty());
    ASSERT_EQ(fresh.depth_m.size(), images.depth_m.size());
    EXPECT_EQ(std::memcmp(fresh.depth_m.data(), images.depth_m.data(),
                          fresh.depth_m.size() * sizeof(float)),
              0)
        << sensor.name;
    const CameraImages other = seen(sensor, scene, pose, kAll, 7);
    const bool has_noise = sensor.image.full_well_e > 0.0;
    EXPECT_EQ(other.left == images.left, !has_noise) << sensor.name;
  }
}

TEST(Camera, LeavesTheDenormalFlagsAsTheyAre) {
  const World world = wall();
  const Scene scene(world);
  const unsigned before = _mm_getcsr();
  for (const SensorSpec& sensor : sensor_presets()) {
    seen(sensor, scene, facing_wall(3.0));
    EXPECT_EQ(_mm_getcsr() & ~0x3FU, before & ~0x3FU) << sensor.name;  // but for sticky exceptions
  }
}

TEST(Camera, RangesAndTheSkyAreKeptByEverySensor) {
  World world = wall();
  const Scene scene(world);
  for (const SensorSpec& sensor : sensor_presets()) {
    const double range_m = sensor.max_range_m;
    for (const double distance_m : {0.5 * range_m, 2.0 * range_m}) {
      if (distance_m > 40.0) continue;  // the wall has an end
      const CameraImages images = seen(sensor, scene, facing_wall(distance_m));
      std::size_t in_range_count = 0;
      for (const float depth_m : images.depth_m) {
        const bool in_range = depth_m >= static_cast<float>(sensor.min_range_m) &&
                              depth_m <= static_cast<float>(range_m);
        ASSERT_TRUE(std::isnan(depth_m) || std::isinf(depth_m) || in_range) << depth_m;
        in_range_count += in_range ? 1 : 0;
      }
      ASSERT_FALSE(images.depth_m.empty());
      if (distance_m < range_m) {
        EXPECT_GT(in_range_count, images.depth_m.size() / 4) << sensor.name;
      } else {
        EXPECT_LT(in_range_count, images.depth_m.size() / 4) << sensor.name;
      }
    }
  }
}

TEST(Camera, MotionBlurSmearsAlongTheMotionAlone) {
  SensorSpec sensor = preset("stereo_sgm");
  sensor.image.full_well_e = 0.0;
  sensor.image.brightness = 0.0;
  sensor.exposure_ms = 20.0;
  const World world = wall();
  const Scene scene(world);
  const Pose pose = facing_wall(2.0);
  CameraMotion motion;
  motion.velocity_world = pose.linear().col(0) * 5.0;  // 0.1 m, 8 px, along the rows
  const auto detail = [&](const CameraImages& images, std::size_t step) {
    double sum = 0.0;
    for (std::size_t y = 50; y < 190; ++y) {
      for (std::size_t x = 50; x < 270; ++x) {
        const std::size_t i = y * 320 + x;
        sum += std::abs(static_cast<double>(images.left[i]) - images.left[i + step]);
      }
    }
    return sum;
  };
  const CameraImages still = seen(sensor, scene, pose, kAll, 1, motion);
  sensor.image.blur_samples = 8;
  const CameraImages blurred = seen(sensor, scene, pose, kAll, 1, motion);
  const CameraImages resting = seen(sensor, scene, pose, kAll, 1, {});
  EXPECT_LT(detail(blurred, 1), 0.5 * detail(still, 1));      // along the row
  EXPECT_GT(detail(blurred, 320), 0.5 * detail(still, 320));  // down the column
  EXPECT_NEAR(detail(resting, 1), detail(still, 1), 0.01 * detail(still, 1));
}

/// Mean difference of two images, of 255.
double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<double>(a[i]) - b[i]);
  return sum / static_cast<double>(a.size());
}

TEST(Camera, TheRightEyesBlurIsThatOfItsOwnWay) {
  SensorSpec sensor = preset("stereo_sgm");
  sensor.image.full_well_e = 0.0;
  sensor.image.brightness = 0.0;
  sensor.image.blur_samples = 8;
  sensor.exposure_ms = 40.0;
  sensor.baseline_m = 1.5;
  const World world = wall();
  const Scene scene(world);
  const Pose pose = facing_wall(2.0);
  // Turned about the left eye, which stays in its place: the right one moves along its view.
  CameraMotion turn;
  turn.rates_world_radps = pose.linear().col(1) * 2.0;
  const CameraImages pair = seen(sensor, scene, pose, kAll, 1, turn);
  const auto right_pose_at = [&](double time_s) {
    const Pose turned = Pose(pose * Eigen::AngleAxisd(2.0 * time_s, Vector3d::UnitY()));
    return Pose(turned * Eigen::Translation3d(sensor.baseline_m, 0.0, 0.0));
  };
  CameraMotion way = turn;
  way.velocity_world =
      (right_pose_at(1e-4).translation() - right_pose_at(-1e-4).translation()) / 2e-4;
  const auto alone = [&](const CameraMotion& motion) {
    return seen(sensor, scene, right_pose_at(0.0), kAll, 1, motion).left;
  };
  EXPECT_LT(difference(pair.right, alone(way)), 0.1);
  CameraMotion back = way;
  back.velocity_world = -way.velocity_world;
  EXPECT_GT(difference(pair.right, alone(turn)), 1.0) << "what the test can see";
  EXPECT_GT(difference(pair.right, alone(back)), 1.0);
}

TEST(Camera, BlandTexturesAreMatchedWorse) {
  double last_valid = 1.1, last_outliers = -1.0;
  for (const double opacity : {1.0, 0.5, 0.25, 0.1, 0.0}) {
    const World world = make_world(HallSpec{.area_m = {20.0, 20.0}, .texture_opacity = opacity}, 3);
    const Scene scene(world);
    const SensorSpec sensor = preset("stereo_sgm");
    const double at_1m_px = disparity_at_1m_px(sensor);
    Camera camera(sensor);
    CameraImages images;
    std::vector<DepthSample> samples;
    for (int i = 0; i < 12; ++i) {
      const Pose pose = test::looking({3.0 + 1.2 * i, 1.5 + 0.4 * i, 1.7}, {0.2, 1.0, 0.0});
      if (scene.nearest(pose.translation(), 0.5).distance_m < 0.5) continue;
      camera.expose(scene, pose, {}, {.depth = true}, static_cast<std::uint64_t>(i), images);
      Pinhole ideal = sensor_camera(sensor);
      std::vector<float> truth(images.depth_m.size());
      std::vector<std::uint32_t> instances(truth.size());
      render_depth(scene, ideal, pose, truth, instances);
      for (std::size_t k = 0; k < truth.size(); ++k) {
        const bool is_cylinder =
            instances[k] != kNoInstance &&
            world.obstacles[world.instances[instances[k]].obstacle].kind == "cylinder";
        if (!is_cylinder) truth[k] = std::numeric_limits<float>::infinity();
      }
      add_samples(truth, images.depth_m, 320, at_1m_px, 8, samples);
    }
    const DepthStatistics s = depth_statistics(samples, false, 0.0, 15.0, at_1m_px);
    EXPECT_LT(s.valid_ratio, last_valid) << opacity;
    EXPECT_GT(s.outlier_ratio, last_outliers) << opacity;
    last_valid = s.valid_ratio;
    last_outliers = s.outlier_ratio;
  }
  EXPECT_LT(last_valid, 0.95);
  EXPECT_GT(last_outliers, 0.03);
}

TEST(SensorPresets, AreNamedApartAndTheFirstIsATrialsDefault) {
  const std::vector<SensorSpec> presets = sensor_presets();
  EXPECT_EQ(presets.front().name, SensorSpec{}.name);
  for (std::size_t i = 0; i < presets.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(presets[i].name, presets[k].name);
  }
  EXPECT_EQ(mountings(preset("surround")).size(), 4U);
}

TEST(SensorPresets, TheOriginalsNumbers) {
  const SensorSpec original = preset("stereo_original");
  EXPECT_NEAR(sensor_camera(original).fx_px, 268.512, 5e-4);
  EXPECT_NEAR(disparity_at_1m_px(original), 32.2214, 5e-5);
  EXPECT_EQ(original.mounting.position_body_m, (std::array{0.2, 0.06, 0.3}));
}

}  // namespace
}  // namespace avoidbench
