#pragma once

#include <cstdint>
#include <span>

#include "render/camera.hpp"
#include "render/scene.hpp"

namespace avoidbench {

/// Light of a shaded image.
struct Light {
  Eigen::Vector3d to_sun_world = Eigen::Vector3d(0.45, -0.35, 0.82).normalized();
  double sun = 0.75;  ///< strength of the direct light
  double sky = 0.45;  ///< strength of the light from above
  bool shadows = true;
  double haze_range_m = 200.0;  ///< distance at which the haze takes 63 % of the colour; +inf: none
};

/// The colour image seen from `T_world_camera`, sRGB 8-bit, `rgb` is height × width × 3, row-major.
/// Materials are procedural and fixed to the object (never to the view), so that two cameras see
/// the same texture. `samples` rays a side of each pixel (1: one ray through its centre).
void render_shaded(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                   const Light& light, int samples, std::span<std::uint8_t> rgb);

}  // namespace avoidbench
