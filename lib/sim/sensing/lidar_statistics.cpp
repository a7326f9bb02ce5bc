#include "sensing/lidar_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/ticks.hpp"

namespace avoidbench {
namespace {

double ratio_of(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : math::kNaN;
}

bool is_within(const LidarShot& shot, double nearest_m, double farthest_m) {
  const auto truth = static_cast<double>(shot.truth_m);
  return truth >= nearest_m && truth < farthest_m;
}

/// Counts alone: of the shots in the range, or of all others.
LidarStatistics counted(std::span<const LidarShot> shots, double nearest_m, double farthest_m,
                        bool inside) {
  LidarStatistics result;
  std::size_t returns = 0, misses = 0, all_misses = 0;
  for (const LidarShot& shot : shots) {
    const bool is_miss = std::isnan(shot.measured_m);
    if (is_miss) ++all_misses;
    if (is_within(shot, nearest_m, farthest_m) != inside) continue;
    ++result.shot_count;
    ++(is_miss ? misses : returns);
  }
  result.return_ratio = ratio_of(returns, result.shot_count);
  result.miss_share = ratio_of(misses, all_misses);
  result.outlier_ratio = result.bias_m = result.sigma_m = math::kNaN;
  return result;
}

}  // namespace

std::vector<float> measured_ranges_m(const LidarSpec& lidar, const LidarSweep& sweep) {
  const std::int64_t count = shots_per_sweep(lidar);
  const double period_s = seconds(required_period(lidar.rate_hz));
  std::vector<float> ranges_m(static_cast<std::size_t>(count),
                              std::numeric_limits<float>::quiet_NaN());
  for (const LidarPoint& point : sweep.points) {
    // Shot i is fired (i + 1) / count of the period after the sweep's start.
    const double share = 1.0 + static_cast<double>(point.time_s) / period_s;
    const std::int64_t shot = std::llround(share * static_cast<double>(count)) - 1;
    AB_CHECK(shot >= 0 && shot < count, shot);
    ranges_m[static_cast<std::size_t>(shot)] = point.position_lidar.norm();
  }
  return ranges_m;
}

double outlier_error_m(const LidarSpec& lidar) { return std::max(0.1, 5.0 * lidar.range_sigma_m); }

LidarStatistics lidar_statistics(std::span<const LidarShot> shots, double nearest_m,
                                 double farthest_m, double outlier_error_m) {
  LidarStatistics result = counted(shots, nearest_m, farthest_m, true);
  std::size_t returns = 0, outliers = 0;
  double sum = 0.0, squares = 0.0;
  for (const LidarShot& shot : shots) {
    if (std::isnan(shot.measured_m) || !is_within(shot, nearest_m, farthest_m)) continue;
    ++returns;
    const double error = static_cast<double>(shot.measured_m) - static_cast<double>(shot.truth_m);
    if (std::abs(error) > outlier_error_m) {
      ++outliers;
      continue;
    }
    sum += error;
    squares += error * error;
  }
  const auto count = static_cast<double>(returns - outliers);
  const double mean = sum / count;
  result.outlier_ratio = ratio_of(outliers, returns);
  result.bias_m = mean;
  result.sigma_m =
      returns > outliers ? std::sqrt(std::max(0.0, squares / count - mean * mean)) : math::kNaN;
  return result;
}

LidarStatistics statistics_beside(std::span<const LidarShot> shots, double nearest_m,
                                  double farthest_m) {
  return counted(shots, nearest_m, farthest_m, false);
}

}  // namespace avoidbench
