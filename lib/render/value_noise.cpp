#include "render/value_noise.hpp"

#include <algorithm>
#include <cmath>

namespace avoidbench {
namespace {

float mix(float a, float b, float t) { return a + (b - a) * t; }

float smooth(float t) { return t * t * (3.0F - 2.0F * t); }

}  // namespace

std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9e3779b9U + static_cast<std::uint32_t>(x) * 0x85ebca6bU +
                    static_cast<std::uint32_t>(y) * 0xc2b2ae35U +
                    static_cast<std::uint32_t>(z) * 0x27d4eb2fU;
  h ^= h >> 15U;
  h *= 0x2c1b3c6dU;
  h ^= h >> 12U;
  h *= 0x297a2d39U;
  h ^= h >> 15U;
  return h;
}

float lattice_value(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  return static_cast<float>(lattice_hash(x, y, z, seed) >> 8U) * 0x1p-24F;
}

float value_noise(const Eigen::Vector3f& point, std::uint32_t seed) {
  const float low_x = std::floor(point.x());
  const float low_y = std::floor(point.y());
  const float low_z = std::floor(point.z());
  const auto x = static_cast<std::int32_t>(low_x);
  const auto y = static_cast<std::int32_t>(low_y);
  const auto z = static_cast<std::int32_t>(low_z);
  const float tx = smooth(point.x() - low_x);
  const float ty = smooth(point.y() - low_y);
  const float tz = smooth(point.z() - low_z);
  float planes[2];
  for (std::int32_t i = 0; i < 2; ++i) {
    const float low =
        mix(lattice_value(x, y, z + i, seed), lattice_value(x + 1, y, z + i, seed), tx);
    const float high =
        mix(lattice_value(x, y + 1, z + i, seed), lattice_value(x + 1, y + 1, z + i, seed), tx);
    planes[i] = mix(low, high, ty);
  }
  return mix(planes[0], planes[1], tz);
}

float fractal_value_noise(const Eigen::Vector3f& point, int octaves, float footprint,
                          std::uint32_t seed) {
  float sum = 0.5F;
  float weight = 0.5F;
  float frequency = 1.0F;
  for (int octave = 0; octave < octaves; ++octave) {
    // A wave must span about two footprints to be seen.
    const float seen = std::clamp(2.0F - 2.0F * footprint * frequency, 0.0F, 1.0F);
    if (seen <= 0.0F) break;
    const float noise = value_noise(point * frequency, seed + static_cast<std::uint32_t>(octave));
    sum += weight * seen * (noise - 0.5F);
    weight *= 0.5F;
    frequency *= 2.0F;
  }
  return sum;
}

}  // namespace avoidbench
