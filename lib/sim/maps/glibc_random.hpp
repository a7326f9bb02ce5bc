#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace avoidbench {

/// The random numbers of glibc's srand() and rand(), the same on every system: its generator
/// TYPE_3, additive feedback r[i] = r[i-3] + r[i-31] modulo 2³², of which the lowest bit is
/// dropped. Only for what others drew with it; own draws are from base/random.hpp.
class GlibcRandom {
 public:
  explicit GlibcRandom(std::uint32_t seed);  ///< as srand(seed); 0 counts as 1
  std::int32_t next();                       ///< as rand(): [0, 2³¹ - 1]

 private:
  static constexpr std::size_t kLags = 31, kShortLag = 3;
  std::array<std::uint32_t, kLags> state_{};  ///< the last 31 sums, the oldest at `oldest_`
  std::size_t oldest_ = kShortLag;            ///< srand() repeats its first three as the latest
};

}  // namespace avoidbench
