#pragma once

#include <cstdint>
#include <limits>

namespace avoidbench {

/// A pinhole camera without distortion, RDF (x right, y down, z forward). Pixel centres are at
/// whole coordinates, the first one (0, 0), so that the principal point of a symmetric camera is
/// ((width - 1)/2, (height - 1)/2).
struct Pinhole {
  std::int32_t width_px = 0, height_px = 0;
  double fx_px = 0.0, fy_px = 0.0, cx_px = 0.0, cy_px = 0.0;
  double min_range_m = 0.0;                                      ///< along z; nearer is invalid
  double max_range_m = std::numeric_limits<double>::infinity();  ///< along z; farther is nothing
};

/// fx = fy from the horizontal field of view, principal point in the middle.
Pinhole make_pinhole(std::int32_t width_px, std::int32_t height_px, double fov_x_rad,
                     double max_range_m);

}  // namespace avoidbench
