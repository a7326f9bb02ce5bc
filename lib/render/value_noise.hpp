#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace avoidbench {

/// 32 well-mixed bits of a lattice point, the same on every machine.
std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

/// The hash as a number in [0, 1).
float lattice_value(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

/// Smooth noise in [0, 1) that takes the lattice's values at whole coordinates; features of about
/// one unit. Coordinates within ±1e9.
float value_noise(const Eigen::Vector3f& point, std::uint32_t seed);

/// The nearest of centres that lie one in each unit cube, anywhere in it (Worley 1996).
struct Cell {
  float square_distance = 1e9F;
  std::uint32_t hash = 0;  ///< of the centre: the same all over its cell
};

Cell nearest_cell(const Eigen::Vector3f& point, std::uint32_t seed);

/// Octaves of value_noise, each of half the wavelength and half the weight of the one before, about
/// in [0, 1] with mean 0.5. Octaves finer than `footprint`, in units of `point`, fade out, so that
/// distant surfaces do not flicker.
float fractal_value_noise(const Eigen::Vector3f& point, int octaves, float footprint,
                          std::uint32_t seed);

}  // namespace avoidbench
