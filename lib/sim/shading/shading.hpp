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

enum class Channels { grey = 1, rgb = 3 };

/// Linear light that reaches the pixels of a camera at `T_world_camera`: `light` is height × width
/// × channels, row-major; a grey card in the sun is about 0.3, and 1 is white. Grey is the Rec. 709
/// luminance. Not clipped; no tone curve, no noise. The sky is seen where nothing is hit within
/// `camera.max_range_m`; `min_range_m` is ignored. Materials are procedural and fixed to the object
/// (never to the view), so that two cameras see the same texture; what is finer than about two
/// pixels fades out of it. `samples` rays a side of each pixel (1: one ray through its centre). The
/// same bits on every machine.
void render_radiance(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                     const Light& light, int samples, Channels channels, std::span<float> radiance);

/// The same as a picture: highlights bent below white, sRGB 8-bit; `rgb` is height × width × 3,
/// row-major.
void render_shaded(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                   const Light& light, int samples, std::span<std::uint8_t> rgb);

struct ShadingKernel;

/// The kernel that render_radiance() uses: the fastest this processor runs.
const ShadingKernel& shading_kernel();

/// render_radiance() by a kernel of shading_kernel.hpp: all give the same bits, which tests see to.
void render_radiance_by(const ShadingKernel& kernel, const Scene& scene, const Pinhole& camera,
                        const Pose& T_world_camera, const Light& light, int samples,
                        Channels channels, std::span<float> radiance);

}  // namespace avoidbench
