#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace avoidbench {

/// The random numbers of .NET's System.Random(seed), the same in every version of .NET and in Mono:
/// Knuth's subtractive generator (The Art of Computer Programming 2, 3.2.2) modulo 2³¹ - 1, with
/// the lags 55 and 34 that .NET has for Knuth's 55 and 24. Only for what others drew with it; own
/// draws are from base/random.hpp.
class DotnetRandom {
 public:
  explicit DotnetRandom(std::int32_t seed);

  std::int32_t next();  ///< Next(): [0, 2³¹ - 1)
  /// Next(lowest, end): [lowest, end), or `lowest` where they are equal. The range must fit into an
  /// int32.
  std::int32_t next(std::int32_t lowest, std::int32_t end);
  double next_double();  ///< NextDouble(): [0, 1), 31 bits

 private:
  static constexpr std::size_t kLags = 55;
  std::array<std::int32_t, kLags> state_{};
  std::size_t at_ = 0;
};

}  // namespace avoidbench
