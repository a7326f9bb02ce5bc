#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace avoidbench {

/// Gradient noise (Perlin, Improving noise, 2002) with lattice gradients hashed from `seed`:
/// smooth, about in [-1, 1], mean 0, features of about one unit.
double gradient_noise(const Eigen::Vector3d& point, std::uint64_t seed);

/// Sum of `octaves` of it, each of half the wavelength and half the height of the one before.
double fractal_noise(const Eigen::Vector3d& point, int octaves, std::uint64_t seed);

}  // namespace avoidbench
