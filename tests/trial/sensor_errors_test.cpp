#include "trial/sensor_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/option_error.hpp"

namespace avoidbench {
namespace {

TrialSpec small_hall(const std::string& sensor) {
  TrialSpec trial;
  trial.map = HallSpec{.area_m = {10, 14}, .poisson_radius_m = 3.0};
  for (const SensorSpec& preset : sensor_presets()) {
    if (preset.name == sensor) trial.sensor = preset;
  }
  trial.sensor.width_px = 80;
  trial.sensor.height_px = 60;
  return trial;
}

TEST(SensorErrors, TrueDepthHasNone) {
  const SensorErrors errors = measure_sensor(small_hall("depth_ideal"), 1);
  const DepthStatistics all = errors.statistics(false, 0.0, errors.sensor.max_range_m);
  EXPECT_GT(all.pixel_count, 1000U);
  EXPECT_EQ(all.valid_ratio, 1.0);
  EXPECT_EQ(all.outlier_ratio, 0.0);
  EXPECT_NEAR(all.disparity_sigma_px, 0.0, 1e-3);
}

TEST(SensorErrors, NoiseIsSeenAndTheSameTwice) {
  const TrialSpec trial = small_hall("depth_noisy");
  const SensorErrors errors = measure_sensor(trial, 1), again = measure_sensor(trial, 1);
  const DepthStatistics all = errors.statistics(false, 0.0, errors.sensor.max_range_m);
  EXPECT_GT(all.disparity_sigma_px, 0.05);
  ASSERT_EQ(errors.samples.size(), again.samples.size());
  EXPECT_EQ(all.disparity_sigma_px,
            again.statistics(false, 0.0, errors.sensor.max_range_m).disparity_sigma_px);
}

TEST(SensorErrors, OneKindOfObstacleAlone) {
  const TrialSpec trial = small_hall("depth_ideal");
  const std::size_t all = measure_sensor(trial, 1).samples.size();
  const std::size_t cylinders = measure_sensor(trial, 1, "cylinder").samples.size();
  EXPECT_GT(cylinders, 0U);
  EXPECT_LT(cylinders, all);
  try {
    measure_sensor(trial, 1, "cilinder");
    FAIL() << "no such kind, and nothing was thrown";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean cylinder?"), std::string::npos);
    EXPECT_EQ(error.option(), "of");
  }
}

/// The hall with a lidar of 2,048 shots a sweep that sees everything, and no camera.
TrialSpec hall_of_lidar() {
  TrialSpec trial = small_hall("velodyne_16");
  LidarSpec lidar;
  lidar.scan = LidarSpinningSpec{.columns = 128};
  lidar.min_range_m = 0.0;
  lidar.range_at_10_percent_m = 1000.0;
  trial.sensor.lidars = {lidar};
  return trial;
}

LidarStatistics statistics_of(const TrialSpec& trial, std::int64_t missions = 3) {
  const SensorErrors errors = measure_sensor(trial, missions);
  EXPECT_TRUE(errors.samples.empty());
  const LidarErrors& lidar = errors.lidars.at(0);
  return lidar_statistics(lidar.shots, 0.0, lidar.lidar.max_range_m, outlier_error_m(lidar.lidar));
}

/// How far a standard deviation of n normal values, and a share of n, may be from the truth: five
/// times their own standard deviations.
double sampling_error(double sigma, std::size_t count) {
  return 5.0 * sigma / std::sqrt(2.0 * static_cast<double>(count));
}
double share_error(double share, std::size_t count) {
  return 5.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(count));
}

TEST(SensorErrors, OfALidarWithoutNoiseThereAreNone) {
  const LidarStatistics all = statistics_of(hall_of_lidar());
  // The hall is closed: every shot meets something.
  EXPECT_EQ(all.shot_count % 2048, 0U);
  EXPECT_GT(all.shot_count, 4U * 2048);
  EXPECT_EQ(all.return_ratio, 1.0);
  EXPECT_EQ(all.outlier_ratio, 0.0);
  EXPECT_NEAR(all.bias_m, 0.0, 1e-6);
  EXPECT_NEAR(all.sigma_m, 0.0, 1e-5);
}

TEST(SensorErrors, OfALidarsRangesAreThoseThatItWasGiven) {
  TrialSpec trial = hall_of_lidar();
  trial.sensor.lidars[0].range_sigma_m = 0.02;
  const LidarStatistics all = statistics_of(trial);
  EXPECT_EQ(all.return_ratio, 1.0);
  EXPECT_NEAR(all.sigma_m, 0.02, sampling_error(0.02, all.shot_count));
  EXPECT_NEAR(all.bias_m, 0.0, 5.0 * 0.02 / std::sqrt(static_cast<double>(all.shot_count)));
  // Beyond five standard deviations: fewer than one in a million.
  EXPECT_LT(all.outlier_ratio, 1e-4);
}

TEST(SensorErrors, OfALidarThatLosesATenthATenthIsLost) {
  TrialSpec trial = hall_of_lidar();
  trial.sensor.lidars[0].dropout_ratio = 0.1;
  const LidarStatistics all = statistics_of(trial);
  EXPECT_NEAR(all.return_ratio, 0.9, share_error(0.1, all.shot_count));
  // In a closed hall each miss is wrong.
  EXPECT_EQ(all.miss_share, 1.0);
  EXPECT_NEAR(all.sigma_m, 0.0, 1e-5);
}

/// Half the shots go into the sky over a meadow with trees.
TEST(SensorErrors, OfShotsAtNothingWideBeamsBringBackFalseReturns) {
  TrialSpec trial = hall_of_lidar();
  trial.map = ForestSpec{};
  LidarSpec& lidar = trial.sensor.lidars[0];
  lidar.max_range_m = 20.0;
  const auto beside = [&] {
    const LidarErrors errors = measure_sensor(trial, 1).lidars.at(0);
    return statistics_beside(errors.shots, 0.0, 20.0);
  };
  EXPECT_GT(beside().shot_count, 1000U);
  EXPECT_EQ(beside().return_ratio, 0.0);
  EXPECT_EQ(beside().miss_share, 1.0);
  EXPECT_EQ(statistics_of(trial, 1).outlier_ratio, 0.0);
  lidar.divergence_mrad = 30.0;
  lidar.rays_per_beam = 16;
  EXPECT_GT(beside().return_ratio, 0.0);
  EXPECT_LT(beside().return_ratio, 0.5);
  EXPECT_GT(statistics_of(trial, 1).outlier_ratio, 0.0);
}

/// Each lidar of a rig has noise of its own, and the camera's is as without them.
TEST(SensorErrors, OfARigAreThoseOfItsCameraAndOfEachLidar) {
  TrialSpec trial = small_hall("depth_noisy");
  const SensorErrors alone = measure_sensor(trial, 1);
  LidarSpec lidar = hall_of_lidar().sensor.lidars[0];
  lidar.range_sigma_m = 0.02;
  trial.sensor.lidars = {lidar, lidar};
  const SensorErrors rig = measure_sensor(trial, 1), again = measure_sensor(trial, 1);
  ASSERT_EQ(rig.samples.size(), alone.samples.size());
  EXPECT_EQ(rig.statistics(false, 0.0, 15.0).disparity_sigma_px,
            alone.statistics(false, 0.0, 15.0).disparity_sigma_px);
  ASSERT_EQ(rig.lidars.size(), 2U);
  const auto first_range_m = [](const SensorErrors& errors, std::size_t index) {
    return errors.lidars[index].shots.at(0).measured_m;
  };
  EXPECT_EQ(rig.lidars[0].shots.at(0).truth_m, rig.lidars[1].shots.at(0).truth_m);
  EXPECT_NE(first_range_m(rig, 0), first_range_m(rig, 1));
  EXPECT_EQ(first_range_m(rig, 0), first_range_m(again, 0));
}

TEST(SensorErrors, OfALidarOnOneKindOfObstacleAlone) {
  const TrialSpec trial = hall_of_lidar();
  const std::vector<LidarShot> all = measure_sensor(trial, 1).lidars.at(0).shots;
  const std::vector<LidarShot> cylinders = measure_sensor(trial, 1, "cylinder").lidars.at(0).shots;
  EXPECT_GT(cylinders.size(), 0U);
  EXPECT_LT(cylinders.size(), all.size());
}

TEST(SensorErrors, PosesKeepAwayFromThings) {
  const TrialSpec trial = small_hall("depth_ideal");
  const World world = make_world(trial.map, trial.map_seed);
  const Scene scene(world);
  const std::vector<Pose> poses = poses_along_missions(scene, trial, 3);
  ASSERT_GE(poses.size(), 3U);
  EXPECT_LE(poses.size(), 12U);
  for (const Pose& pose : poses) {
    EXPECT_GE(scene.nearest(pose.translation(), 1.0).distance_m, 0.6);
  }
}

}  // namespace
}  // namespace avoidbench
