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
