#pragma once

#include <string>
#include <vector>

#include "render/scene.hpp"
#include "sensing/depth_statistics.hpp"
#include "sensing/lidar_statistics.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// What was measured of one lidar of a sensor: a sweep from each pose.
struct LidarErrors {
  LidarSpec lidar;
  std::vector<LidarShot> shots = {};
};

/// What was measured of one sensor on one map.
struct SensorErrors {
  SensorSpec sensor;
  std::vector<DepthSample> samples = {};  ///< none where the sensor has no camera
  double fattening_px = 0.0;              ///< mean over images; NaN where there are no steps
  double error_size_px = 0.0;             ///< the same of error_size_px()
  std::vector<LidarErrors> lidars = {};

  /// Of the samples near steps in depth or away from them, within these true depths.
  DepthStatistics statistics(bool edges, double nearest_m, double farthest_m) const;
};

/// Poses of a level body along the straight lines of missions 0 to `mission_count` - 1, at each
/// quarter of the way, without those where something is nearer than 0.6 m.
std::vector<Pose> poses_along_missions(const Scene& scene, const TrialSpec& trial,
                                       std::int64_t mission_count);

/// Errors of the trial's sensor against the truth on the trial's map, from poses_along_missions(),
/// at each of which it rests. `kind`: only where the truth is an obstacle of this kind; "":
/// everywhere. Throws InputError where the map has none of the kind.
SensorErrors measure_sensor(const TrialSpec& trial, std::int64_t mission_count,
                            const std::string& kind = "");

}  // namespace avoidbench
