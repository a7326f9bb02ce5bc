#include "sensing/image_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"
#include "shading/srgb.hpp"

namespace avoidbench {

std::vector<float> vignette(const ImageSpec& image, const Pinhole& camera) {
  std::vector<float> shares;
  shares.reserve(static_cast<std::size_t>(camera.width_px) *
                 static_cast<std::size_t>(camera.height_px));
  for (std::int32_t y = 0; y < camera.height_px; ++y) {
    for (std::int32_t x = 0; x < camera.width_px; ++x) {
      const double u = (x - camera.cx_px) / camera.fx_px;
      const double v = (y - camera.cy_px) / camera.fy_px;
      const double cosine_squared = 1.0 / (1.0 + u * u + v * v);
      // Natural vignetting, cos⁴ of the angle off the axis.
      const double loss = 1.0 - cosine_squared * cosine_squared;
      shares.push_back(static_cast<float>(1.0 - image.vignetting * loss));
    }
  }
  return shares;
}

double exposure_gain(const ImageSpec& image, double mean_light) {
  if (image.brightness == 0.0) return 1.0;
  // The limits of the automatic exposure: four stops up and down.
  // A black image would ask for an infinite gain.
  return std::clamp(image.brightness / std::max(mean_light, 1e-9), 1.0 / 16.0, 16.0);
}

double mean_light(std::span<const float> light) {
  double sum = 0.0;
  for (const float value : light) sum += static_cast<double>(value);
  return light.empty() ? 0.0 : sum / static_cast<double>(light.size());
}

void develop(const ImageSpec& image, std::span<const float> light, std::span<const float> vignette,
             double gain, RandomStream& random, std::span<std::uint8_t> pixels) {
  const SrgbTable& srgb = srgb_table();
  AB_CHECK(pixels.size() == light.size() && light.size() % vignette.size() == 0, light.size());
  const std::size_t channels = light.size() / vignette.size();
  const bool has_noise = image.full_well_e > 0.0;
  // In units of the full well, which light of 1 fills.
  const double per_electron = has_noise ? 1.0 / image.full_well_e : 0.0;
  const auto shot_variance = static_cast<float>(per_electron);
  const double read_sigma = image.read_noise_e * per_electron;
  const auto read_variance = static_cast<float>(read_sigma * read_sigma);
  const auto factor = static_cast<float>(gain);
  // Normals for so many pixels at a time stay in the first cache.
  constexpr std::size_t kChunk = 1024;
  std::array<float, kChunk> normals{};
  for (std::size_t begin = 0; begin < light.size(); begin += kChunk) {
    const std::size_t count = std::min(kChunk, light.size() - begin);
    if (has_noise) random.coarse_normals({normals.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = begin + i;
      const std::size_t pixel = channels == 1 ? at : at / channels;
      float level = light[at] * factor * vignette[pixel];
      // Poisson noise as a normal: a full well has thousands of electrons.
      level += std::sqrt(level * shot_variance + read_variance) * normals[i];
      level = std::min(std::max(level, 0.0F), 1.0F);
      // Rounded by truncation: levels are never negative.
      const float half_up = level * static_cast<float>(srgb.size() - 1) + 0.5F;
      pixels[at] = srgb[static_cast<std::size_t>(half_up)];
    }
  }
}

}  // namespace avoidbench
