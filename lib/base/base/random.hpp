#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace avoidbench {

/// A stream of random numbers (xoshiro256**), the same on every machine and compiler: our own
/// draws, since the standard library's distributions differ between implementations. Never draw
/// twice in one expression: compilers order the operands differently.
class RandomStream {
 public:
  /// `seed` is spread over the state by SplitMix64; every seed is good, 0 too.
  explicit RandomStream(std::uint64_t seed);

  std::uint64_t bits();                           ///< 64 random bits
  double uniform();                               ///< [0, 1), 53 bits
  double uniform(double lowest, double highest);  ///< [lowest, highest)
  std::uint64_t below(std::uint64_t count);       ///< [0, count), unbiased; count > 0
  double normal();  ///< mean 0, variance 1 (polar method; both values used)
  /// Fills with normals of mean 0 and variance 1 in 4096 steps, the farthest at 3.7: for images,
  /// ten times as fast as normal(). Draws 64 bits for each five values begun.
  void coarse_normals(std::span<float> values);

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_normal_ = 0.0;
  bool has_spare_ = false;
};

/// The seed of the stream `name` of `seed`: streams of other names or seeds are independent, so
/// that adding a draw to one never moves another. Chain it for nested streams:
/// stream_seed(stream_seed(seed, "mission"), index).
std::uint64_t stream_seed(std::uint64_t seed, std::string_view name);
std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t index);

inline RandomStream stream(std::uint64_t seed, std::string_view name) {
  return RandomStream(stream_seed(seed, name));
}

}  // namespace avoidbench
