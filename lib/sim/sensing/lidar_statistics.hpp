#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sensing/lidar.hpp"

namespace avoidbench {

/// One shot whose truth is known. Ranges are along the reported direction, from the lidar.
struct LidarShot {
  float truth_m = 0;     ///< of the first surface along it; +inf: none
  float measured_m = 0;  ///< NaN: a miss
};

/// What a sweep of a lidar that rests measured, a value a shot of the sweep, in their order; NaN
/// for misses.
std::vector<float> measured_ranges_m(const LidarSpec& lidar, const LidarSweep& sweep);

/// Errors beyond this are outliers, most of them of beams that meet edges or flat surfaces beside
/// where they are said to point: five times range_sigma_m, and no less than 0.1 m.
double outlier_error_m(const LidarSpec& lidar);

/// What a lidar does to true ranges.
struct LidarStatistics {
  std::size_t shot_count = 0;
  double return_ratio = 0;   ///< of the shots: they came back
  double outlier_ratio = 0;  ///< of those: their errors are beyond outlier_error_m()
  double bias_m = 0;         ///< mean of the errors of the others
  double sigma_m = 0;        ///< their standard deviation
  double miss_share = 0;     ///< of all misses, whatever their truth: those of these shots
};

/// Over the shots with a truth in [nearest_m, farthest_m) metres; NaN where there are none.
LidarStatistics lidar_statistics(std::span<const LidarShot> shots, double nearest_m,
                                 double farthest_m, double outlier_error_m);

/// The same over the shots that meet no surface in [nearest_m, farthest_m): what returns of them is
/// false, and has no error.
LidarStatistics statistics_beside(std::span<const LidarShot> shots, double nearest_m,
                                  double farthest_m);

}  // namespace avoidbench
