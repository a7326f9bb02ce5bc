#include "render/value_noise.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <array>

namespace avoidbench {
namespace {

constexpr std::uint32_t kX = 0x85ebca6bU, kY = 0xc2b2ae35U, kZ = 0x27d4eb2fU, kSeed = 0x9e3779b9U;
constexpr std::uint32_t kFirst = 0x2c1b3c6dU, kSecond = 0x297a2d39U;

/// Low 32 bits of each lane's product.
[[gnu::always_inline]] inline __m128i product(__m128i a, __m128i b) {
  const __m128i even = _mm_mul_epu32(a, b);
  const __m128i odd = _mm_mul_epu32(_mm_srli_si128(a, 4), _mm_srli_si128(b, 4));
  return _mm_unpacklo_epi32(_mm_shuffle_epi32(even, _MM_SHUFFLE(0, 0, 2, 0)),
                            _mm_shuffle_epi32(odd, _MM_SHUFFLE(0, 0, 2, 0)));
}

[[gnu::always_inline]] inline __m128i all(std::uint32_t value) {
  return _mm_set1_epi32(static_cast<int>(value));
}

/// lattice_value() of four keys, to the bit.
[[gnu::always_inline]] inline __m128 values(__m128i key) {
  __m128i h = _mm_xor_si128(key, _mm_srli_epi32(key, 15));
  h = product(h, all(kFirst));
  h = _mm_xor_si128(h, _mm_srli_epi32(h, 12));
  h = product(h, all(kSecond));
  h = _mm_xor_si128(h, _mm_srli_epi32(h, 15));
  return _mm_mul_ps(_mm_cvtepi32_ps(_mm_srli_epi32(h, 8)), _mm_set1_ps(0x1p-24F));
}

std::uint32_t lattice_key(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  return seed * kSeed + static_cast<std::uint32_t>(x) * kX + static_cast<std::uint32_t>(y) * kY +
         static_cast<std::uint32_t>(z) * kZ;
}

/// Without a call into the C library, which std::floor is on plain x86-64.
std::int32_t floor_int(float x) {
  const auto toward_zero = static_cast<std::int32_t>(x);
  return toward_zero - (x < static_cast<float>(toward_zero) ? 1 : 0);
}

float mix(float a, float b, float t) { return a + (b - a) * t; }

float smooth(float t) { return t * t * (3.0F - 2.0F * t); }

}  // namespace

std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  std::uint32_t h = lattice_key(x, y, z, seed);
  h = (h ^ (h >> 15U)) * kFirst;
  h = (h ^ (h >> 12U)) * kSecond;
  return h ^ (h >> 15U);
}

float lattice_value(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  return static_cast<float>(lattice_hash(x, y, z, seed) >> 8U) * 0x1p-24F;
}

float value_noise(const Eigen::Vector3f& point, std::uint32_t seed) {
  const std::int32_t x = floor_int(point.x());
  const std::int32_t y = floor_int(point.y());
  const std::int32_t z = floor_int(point.z());
  const float tx = smooth(point.x() - static_cast<float>(x));
  const float ty = smooth(point.y() - static_cast<float>(y));
  const float tz = smooth(point.z() - static_cast<float>(z));
  // Four corners at a time: (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
  const __m128i corners =
      _mm_setr_epi32(0, static_cast<int>(kX), static_cast<int>(kY), static_cast<int>(kX + kY));
  const __m128i keys = _mm_add_epi32(all(lattice_key(x, y, z, seed)), corners);
  const __m128 low = values(keys);
  const __m128 high = values(_mm_add_epi32(keys, all(kZ)));
  alignas(16) std::array<float, 4> level;
  _mm_store_ps(level.data(), _mm_add_ps(low, _mm_mul_ps(_mm_sub_ps(high, low), _mm_set1_ps(tz))));
  return mix(mix(level[0], level[1], tx), mix(level[2], level[3], tx), ty);
}

Cell nearest_cell(const Eigen::Vector3f& point, std::uint32_t seed) {
  Cell best;
  // The lattice cell that holds the point and its neighbours on the nearer side: the nearest centre
  // is nearly always there.
  const std::int32_t x = floor_int(point.x() - 0.5F);
  const std::int32_t y = floor_int(point.y() - 0.5F);
  const std::int32_t z = floor_int(point.z() - 0.5F);
  for (std::int32_t i = 0; i < 8; ++i) {
    const std::int32_t cx = x + (i & 1);
    const std::int32_t cy = y + ((i >> 1) & 1);
    const std::int32_t cz = z + (i >> 2);
    const std::uint32_t hash = lattice_hash(cx, cy, cz, seed);
    const Eigen::Vector3f jitter(static_cast<float>(hash & 0x3ffU),
                                 static_cast<float>((hash >> 10U) & 0x3ffU),
                                 static_cast<float>((hash >> 20U) & 0x3ffU));
    const Eigen::Vector3f center =
        Eigen::Vector3f(static_cast<float>(cx), static_cast<float>(cy), static_cast<float>(cz)) +
        jitter * 0x1p-10F;
    const float square = (point - center).squaredNorm();
    if (square < best.square_distance) best = {square, hash};
  }
  return best;
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
