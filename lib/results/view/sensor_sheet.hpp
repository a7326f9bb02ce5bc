#pragma once

#include <string>
#include <vector>

#include "drawing/picture.hpp"
#include "render/scene.hpp"
#include "sensing/sensor_spec.hpp"

namespace avoidbench {

/// What a sensor makes of one view.
struct SensorSheet {
  /// Left, right, color, disparity, depth, truth and error of each camera; each lidar's ranges, and
  /// its points from above.
  Picture picture;
  std::string summary;  ///< a line of figures a camera or lidar
};

/// sheet (all the others), left, right, color, disparity (of sensors that match), depth, truth,
/// error.
std::vector<std::string> sensor_view_names();

/// Exposes all cameras of the sensor, and sweeps its lidars, on a body at `T_world_body` that
/// rests. `view` is one of sensor_view_names(). Throws InputError where the sensor has no such
/// view.
SensorSheet make_sensor_sheet(const SensorSpec& sensor, const Scene& scene,
                              const Pose& T_world_body, std::uint64_t seed,
                              const std::string& view);

}  // namespace avoidbench
