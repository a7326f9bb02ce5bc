// The census matcher for every x86-64 machine: SSE2, which all of them have.
#include <emmintrin.h>

#include <cstddef>
#include <cstdint>

#include "sensing/census_kernels.hpp"

namespace avoidbench::census {
namespace {

using Bytes = __m128i;  ///< 16 × 8 bits
using Words = __m128i;  ///< 8 × 16 bits
constexpr int kBytes = 16, kWords = 8;

inline Bytes load(const std::uint8_t* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}
inline void store(std::uint8_t* to, Bytes v) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), v);
}
inline Bytes broadcast(std::uint8_t v) { return _mm_set1_epi8(static_cast<char>(v)); }
inline Bytes add(Bytes a, Bytes b) { return _mm_add_epi8(a, b); }
inline Bytes subtract(Bytes a, Bytes b) { return _mm_sub_epi8(a, b); }
inline Bytes add_saturated(Bytes a, Bytes b) { return _mm_adds_epu8(a, b); }
inline Bytes min(Bytes a, Bytes b) { return _mm_min_epu8(a, b); }
inline Bytes max(Bytes a, Bytes b) { return _mm_max_epu8(a, b); }
inline Bytes equal(Bytes a, Bytes b) { return _mm_cmpeq_epi8(a, b); }
inline Bytes either(Bytes a, Bytes b) { return _mm_or_si128(a, b); }
inline Bytes exclusive_or(Bytes a, Bytes b) { return _mm_xor_si128(a, b); }

/// 255 in the last `count` bytes, 0 or 16.
inline Bytes bytes_from(int count) { return _mm_set1_epi8(count > 0 ? -1 : 0); }

/// Set bits of two bytes together by half bytes, at most 8 in each.
inline Bytes half_byte_bits(Bytes a, Bytes b) {
  const Bytes odd = _mm_set1_epi8(0x55);
  const Bytes pairs = _mm_set1_epi8(0x33);
  a = _mm_sub_epi8(a, _mm_and_si128(_mm_srli_epi16(a, 1), odd));
  b = _mm_sub_epi8(b, _mm_and_si128(_mm_srli_epi16(b, 1), odd));
  a = _mm_add_epi8(_mm_and_si128(a, pairs), _mm_and_si128(_mm_srli_epi16(a, 2), pairs));
  b = _mm_add_epi8(_mm_and_si128(b, pairs), _mm_and_si128(_mm_srli_epi16(b, 2), pairs));
  return _mm_add_epi8(a, b);
}
/// Set bits of four bytes together.
inline Bytes count_bits(Bytes a, Bytes b, Bytes c, Bytes d) {
  const Bytes low = _mm_set1_epi8(15);
  const Bytes ab = half_byte_bits(a, b);
  const Bytes cd = half_byte_bits(c, d);
  const Bytes lower = _mm_add_epi8(_mm_and_si128(ab, low), _mm_and_si128(cd, low));
  const Bytes upper = _mm_add_epi8(_mm_and_si128(_mm_srli_epi16(ab, 4), low),
                                   _mm_and_si128(_mm_srli_epi16(cd, 4), low));
  return _mm_add_epi8(lower, upper);
}

/// Set bits of two bytes together, of which the second has its lower four alone.
inline Bytes count_bits(Bytes a, Bytes b) {
  const Bytes low = _mm_set1_epi8(15);
  const Bytes bits = half_byte_bits(a, b);
  return _mm_add_epi8(_mm_and_si128(bits, low), _mm_and_si128(_mm_srli_epi16(bits, 4), low));
}

/// Every byte's neighbour before it; that of the first is the last of `before`.
inline Bytes one_before(Bytes before, Bytes v) {
  return _mm_or_si128(_mm_slli_si128(v, 1), _mm_srli_si128(before, 15));
}
inline Bytes one_after(Bytes v, Bytes after) {
  return _mm_or_si128(_mm_srli_si128(v, 1), _mm_slli_si128(after, 15));
}

/// The least byte, everywhere.
inline Bytes spread_least(Bytes v) {
  v = _mm_min_epu8(v, _mm_shuffle_epi32(v, 0x4E));
  v = _mm_min_epu8(v, _mm_shuffle_epi32(v, 0xB1));
  v = _mm_min_epu8(v, _mm_or_si128(_mm_srli_epi32(v, 16), _mm_slli_epi32(v, 16)));
  return _mm_min_epu8(v, _mm_or_si128(_mm_srli_epi16(v, 8), _mm_slli_epi16(v, 8)));
}
inline std::uint8_t lowest_byte(Bytes v) { return static_cast<std::uint8_t>(_mm_cvtsi128_si32(v)); }

inline Words load_words(const std::uint16_t* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}
inline void store_words(std::uint16_t* to, Words v) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), v);
}
inline Words load_signed(const std::int16_t* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}
inline void store_signed(std::int16_t* to, Words v) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), v);
}
inline Words spread_word(int v) { return _mm_set1_epi16(static_cast<short>(v)); }
inline Words first_words() { return _mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7); }
inline Words add_words(Words a, Words b) { return _mm_add_epi16(a, b); }
inline Words min_words(Words a, Words b) { return _mm_sub_epi16(a, _mm_subs_epu16(a, b)); }
inline Words min_signed(Words a, Words b) { return _mm_min_epi16(a, b); }
inline Words max_signed(Words a, Words b) { return _mm_max_epi16(a, b); }

/// Every word's neighbour after it; that of the last is the first of `after`.
inline Words word_after(Words v, Words after) {
  return _mm_or_si128(_mm_srli_si128(v, 2), _mm_slli_si128(after, 14));
}
inline int least_word(Words v) {
  v = min_words(v, _mm_shuffle_epi32(v, 0x4E));
  v = min_words(v, _mm_shuffle_epi32(v, 0xB1));
  v = min_words(v, _mm_srli_epi32(v, 16));
  return _mm_cvtsi128_si32(v) & 0xFFFF;
}

/// 64 (a + b) in words, the lower half of them first.
inline void sum_as_words(Bytes a, Bytes b, Words (&out)[2]) {
  const __m128i zero = _mm_setzero_si128();
  const Words low = _mm_add_epi16(_mm_unpacklo_epi8(a, zero), _mm_unpacklo_epi8(b, zero));
  const Words high = _mm_add_epi16(_mm_unpackhi_epi8(a, zero), _mm_unpackhi_epi8(b, zero));
  out[0] = _mm_slli_epi16(low, 6);
  out[1] = _mm_slli_epi16(high, 6);
}
/// 64 (a + b + c + d), the same way.
inline void sum_as_words(Bytes a, Bytes b, Bytes c, Bytes d, Words (&out)[2]) {
  Words others[2];
  sum_as_words(a, b, out);
  sum_as_words(c, d, others);
  out[0] = _mm_add_epi16(out[0], others[0]);
  out[1] = _mm_add_epi16(out[1], others[1]);
}

}  // namespace
}  // namespace avoidbench::census

#include "sensing/census_kernels_body.hpp"

namespace avoidbench::census {

const Kernels& portable_kernels() { return kKernels; }

}  // namespace avoidbench::census
