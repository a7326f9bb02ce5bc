#include "sensing/lidar_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace avoidbench {
namespace {

constexpr float kNoReturn = std::numeric_limits<float>::quiet_NaN();
constexpr float kNoSurface = std::numeric_limits<float>::infinity();

/// Worked out by hand: of six shots at surfaces from 1 to 10 m four come back, one of them from
/// elsewhere; of three at nothing one comes back.
TEST(LidarStatistics, OfNineShots) {
  const std::vector<LidarShot> shots{{2.0F, 2.25F},      {3.0F, 2.75F},     {4.0F, 4.5F},
                                     {5.0F, 9.0F},       {6.0F, kNoReturn}, {7.0F, kNoReturn},
                                     {20.0F, kNoReturn}, {0.5F, kNoReturn}, {kNoSurface, 3.0F}};
  const LidarStatistics all = lidar_statistics(shots, 1.0, 10.0, 1.0);
  EXPECT_EQ(all.shot_count, 6U);
  EXPECT_DOUBLE_EQ(all.return_ratio, 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(all.outlier_ratio, 0.25);
  // Errors of 0.25, -0.25 and 0.5 m.
  EXPECT_DOUBLE_EQ(all.bias_m, 0.5 / 3.0);
  EXPECT_DOUBLE_EQ(all.sigma_m, std::sqrt(0.375 / 3.0 - 0.25 / 9.0));
  EXPECT_DOUBLE_EQ(all.miss_share, 0.5);

  const LidarStatistics beside = statistics_beside(shots, 1.0, 10.0);
  EXPECT_EQ(beside.shot_count, 3U);
  EXPECT_DOUBLE_EQ(beside.return_ratio, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(beside.miss_share, 0.5);
  EXPECT_TRUE(std::isnan(beside.sigma_m));
}

TEST(LidarStatistics, OfNothingAreNoNumbers) {
  const std::vector<LidarShot> shots{{2.0F, 2.25F}};
  const LidarStatistics none = lidar_statistics(shots, 3.0, 4.0, 0.1);
  EXPECT_EQ(none.shot_count, 0U);
  EXPECT_TRUE(std::isnan(none.return_ratio) && std::isnan(none.bias_m));
  EXPECT_TRUE(std::isnan(none.sigma_m) && std::isnan(none.miss_share));
  // An outlier alone has no error either.
  EXPECT_TRUE(std::isnan(lidar_statistics(shots, 2.0, 3.0, 0.1).sigma_m));
}

/// Times are floats: of the quickest lidars, too, they still tell the shots apart.
TEST(LidarStatistics, ShotsAreToldApartByTheirTimes) {
  LidarSpec quick;
  quick.scan = LidarSpinningSpec{.rings = 256, .columns = 8192};
  LidarSpec slow = quick;
  quick.rate_hz = 100.0;
  slow.rate_hz = 1.0;
  for (const LidarSpec& lidar : {quick, slow}) {
    const std::int64_t count = shots_per_sweep(lidar);
    LidarSweep sweep;
    for (std::int64_t i = 0; i < count; i += 3) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(count);
      const auto range_m = static_cast<float>(i % 1000);
      sweep.points.push_back({.position_lidar = {0.0F, range_m, 0.0F},
                              .time_s = static_cast<float>((share - 1.0) / lidar.rate_hz)});
    }
    const std::vector<float> ranges_m = measured_ranges_m(lidar, sweep);
    ASSERT_EQ(ranges_m.size(), static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      const float range_m = ranges_m[static_cast<std::size_t>(i)];
      ASSERT_EQ(std::isnan(range_m), i % 3 != 0);
      if (i % 3 == 0) {
        ASSERT_EQ(range_m, static_cast<float>(i % 1000));
      }
    }
  }
}

}  // namespace
}  // namespace avoidbench
