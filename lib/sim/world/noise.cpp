#include "world/noise.hpp"

#include <array>
#include <cmath>

namespace avoidbench {
namespace {

/// Multiply and shift, with the constants of SplitMix64. In whole numbers, so that it is the same
/// everywhere.
std::uint64_t lattice_hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  std::uint64_t h = seed;
  for (const std::int64_t value : {x, y, z}) {
    h = (h ^ static_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 29U;
  }
  h *= 0xbf58476d1ce4e5b9ULL;
  return h ^ (h >> 32U);
}

/// The offset's product with one of the twelve directions to a cube's edges.
double gradient_product(std::uint64_t hash, const Eigen::Vector3d& offset) {
  const std::uint64_t edge = hash % 12U;
  const double a = edge < 8U ? offset.x() : offset.y();
  const double b = edge < 4U ? offset.y() : offset.z();
  return ((edge & 1U) != 0U ? -a : a) + ((edge & 2U) != 0U ? -b : b);
}

/// Perlin's (2002): first and second derivative are 0 at the ends.
double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

double mix(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

double gradient_noise(const Eigen::Vector3d& point, std::uint64_t seed) {
  const Eigen::Vector3d low(std::floor(point.x()), std::floor(point.y()), std::floor(point.z()));
  // The unit cube around the point: each corner pulls by its own direction's slope.
  const Eigen::Vector3d offset = point - low;
  std::array<double, 8> corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d corner((i & 1U) != 0U ? 1.0 : 0.0, (i & 2U) != 0U ? 1.0 : 0.0,
                                 (i & 4U) != 0U ? 1.0 : 0.0);
    const Eigen::Vector3d place = low + corner;
    const std::uint64_t hash =
        lattice_hash(static_cast<std::int64_t>(place.x()), static_cast<std::int64_t>(place.y()),
                     static_cast<std::int64_t>(place.z()), seed);
    corners[i] = gradient_product(hash, offset - corner);
  }
  // Mixed along x, then y, then z.
  const double x = fade(offset.x());
  const double y = fade(offset.y());
  const double low_z = mix(mix(corners[0], corners[1], x), mix(corners[2], corners[3], x), y);
  const double high_z = mix(mix(corners[4], corners[5], x), mix(corners[6], corners[7], x), y);
  return mix(low_z, high_z, fade(offset.z()));
}

double fractal_noise(const Eigen::Vector3d& point, int octaves, std::uint64_t seed) {
  double sum = 0.0;
  double scale = 1.0;
  for (int octave = 0; octave < octaves; ++octave) {
    // Each octave has its own seed: else all would be 0 at the same lattice points.
    sum += gradient_noise(point * scale, seed + static_cast<std::uint64_t>(octave)) / scale;
    scale *= 2.0;
  }
  return sum;
}

}  // namespace avoidbench
