#include "base/random.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"

namespace avoidbench {
namespace {

/// SplitMix64 (Steele, Lea and Flood 2014): advances `state` and returns a well mixed value.
std::uint64_t split_mix(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

// A table of 16 KiB stays in the first cache; five draws of 12 bits come from one number of 64. The
// farthest of 4096 quantiles is at 3.7 deviations.
constexpr unsigned kCoarseBits = 12;
constexpr std::size_t kCoarseLevels = std::size_t{1} << kCoarseBits;

/// The normal's quantiles at the middles of equal shares, scaled to variance 1.
std::vector<float> make_coarse_normals() {
  std::vector<double> quantiles(kCoarseLevels);
  double square_sum = 0.0;
  for (std::size_t i = 0; i < kCoarseLevels; ++i) {
    quantiles[i] =
        normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(kCoarseLevels));
    square_sum += quantiles[i] * quantiles[i];
  }
  // Middles of shares have a little less variance than the normal.
  const double scale = std::sqrt(static_cast<double>(kCoarseLevels) / square_sum);
  std::vector<float> normals;
  for (const double quantile : quantiles) normals.push_back(static_cast<float>(scale * quantile));
  return normals;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed) : state_{} {
  // As xoshiro's authors advise: SplitMix64 never gives four zeros, the one state that can't be
  // left.
  for (std::uint64_t& word : state_) word = split_mix(seed);
}

// xoshiro256** 1.0 (Blackman and Vigna 2018).
std::uint64_t RandomStream::bits() {
  const std::uint64_t result = std::rotl(state_[1] * 5U, 7) * 9U;
  const std::uint64_t shifted = state_[1] << 17U;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

// 53 bits: what a double in [0, 1) holds.
double RandomStream::uniform() { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }

double RandomStream::uniform(double lowest, double highest) {
  return lowest + (highest - lowest) * uniform();
}

std::uint64_t RandomStream::below(std::uint64_t count) {
  AB_CHECK(count > 0);
  std::uint64_t value = bits();
  // Values below 2^64 mod count would bias and are redrawn. That is less than count: nearly every
  // value needs one division only.
  if (value < count) {
    const std::uint64_t limit = (0 - count) % count;
    while (value < limit) value = bits();
  }
  return value % count;
}

/// Marsaglia's polar method, which makes two of them at once; the second one is kept for the next
/// call.
double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  double x = 0.0, y = 0.0, square = 0.0;
  do {
    x = uniform(-1.0, 1.0);
    y = uniform(-1.0, 1.0);
    square = x * x + y * y;
  } while (square >= 1.0 || square == 0.0);
  const double factor = std::sqrt(-2.0 * math::log(square) / square);
  spare_normal_ = y * factor;
  has_spare_ = true;
  return x * factor;
}

void RandomStream::coarse_normals(std::span<float> values) {
  static const std::vector<float> kNormals = make_coarse_normals();
  constexpr std::size_t kPerDraw = 5;  // of 12 bits each
  for (std::size_t i = 0; i < values.size(); i += kPerDraw) {
    // A rest of fewer than five takes a whole draw, too.
    std::uint64_t word = bits();
    const std::size_t count = std::min(kPerDraw, values.size() - i);
    for (std::size_t k = 0; k < count; ++k, word >>= kCoarseBits) {
      values[i + k] = kNormals[word & (kCoarseLevels - 1)];
    }
  }
}

std::uint64_t stream_seed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return stream_seed(seed, hash);
}

/// Mixed before and after: neighbouring seeds or indices give unlike streams, and (1, 2) is not (2,
/// 1).
std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t state = seed;
  const std::uint64_t mixed = split_mix(state) ^ index;
  state = mixed;
  return split_mix(state);
}

}  // namespace avoidbench
