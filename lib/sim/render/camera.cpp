#include "render/camera.hpp"

#include "base/check.hpp"
#include "base/math.hpp"

namespace avoidbench {

Pinhole make_pinhole(std::int32_t width_px, std::int32_t height_px, double fov_x_rad,
                     double max_range_m) {
  AB_CHECK(width_px > 0 && height_px > 0, width_px, height_px);
  AB_CHECK(fov_x_rad > 0.0 && fov_x_rad < math::kPi, fov_x_rad);
  AB_CHECK(max_range_m > 0.0, max_range_m);
  Pinhole camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = 0.5 * width_px / math::tan(0.5 * fov_x_rad);
  camera.fy_px = camera.fx_px;
  // Pixels' middles have whole coordinates, so the image's middle is at (width - 1) / 2.
  camera.cx_px = 0.5 * (width_px - 1);
  camera.cy_px = 0.5 * (height_px - 1);
  camera.max_range_m = max_range_m;
  return camera;
}

}  // namespace avoidbench
