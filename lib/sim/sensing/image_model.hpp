#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "render/camera.hpp"
#include "sensing/sensor_spec.hpp"

namespace avoidbench {

/// Share of light that reaches each pixel through the lens, height × width, row-major: 1 on the
/// axis, less by `image.vignetting` of 1 − cos⁴ elsewhere.
std::vector<float> vignette(const ImageSpec& image, const Pinhole& camera);

/// The factor that automatic exposure puts on light whose mean is `mean_light`; 1 where exposure is
/// fixed. Within 1/16 and 16.
double exposure_gain(const ImageSpec& image, double mean_light);

/// Mean of `light`, added up in one fixed order.
double mean_light(std::span<const float> light);

/// The 8-bit sRGB picture that the sensor makes of `light` (pixels × channels, linear, 1 = white):
/// gain, vignette (one a pixel), shot and read noise in electrons, clipping at white, encoding.
/// `pixels` has the size of `light`. Draws one normal a value.
void develop(const ImageSpec& image, std::span<const float> light, std::span<const float> vignette,
             double gain, RandomStream& random, std::span<std::uint8_t> pixels);

}  // namespace avoidbench
