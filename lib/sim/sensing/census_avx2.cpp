// Compiled for AVX2 and called only where the processor has it (CMakeLists.txt). It includes
// nothing with functions but intrinsics: the linker could take one compiled here for all of the
// program.
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "sensing/census_kernels.hpp"

namespace avoidbench::census {
namespace {

using Bytes = __m256i;  ///< 32 × 8 bits
using Words = __m256i;  ///< 16 × 16 bits
constexpr int kBytes = 32, kWords = 16;

inline Bytes load(const std::uint8_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}
inline void store(std::uint8_t* to, Bytes v) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), v);
}
inline Bytes broadcast(std::uint8_t v) { return _mm256_set1_epi8(static_cast<char>(v)); }
inline Bytes add(Bytes a, Bytes b) { return _mm256_add_epi8(a, b); }
inline Bytes subtract(Bytes a, Bytes b) { return _mm256_sub_epi8(a, b); }
inline Bytes add_saturated(Bytes a, Bytes b) { return _mm256_adds_epu8(a, b); }
inline Bytes min(Bytes a, Bytes b) { return _mm256_min_epu8(a, b); }
inline Bytes max(Bytes a, Bytes b) { return _mm256_max_epu8(a, b); }
inline Bytes equal(Bytes a, Bytes b) { return _mm256_cmpeq_epi8(a, b); }
inline Bytes either(Bytes a, Bytes b) { return _mm256_or_si256(a, b); }
inline Bytes exclusive_or(Bytes a, Bytes b) { return _mm256_xor_si256(a, b); }

/// 255 in the last `count` bytes, 0 or 16.
inline Bytes bytes_from(int count) {
  return _mm256_set_m128i(_mm_set1_epi8(count > 0 ? -1 : 0), _mm_setzero_si128());
}

/// Set bits of four bytes together, by the number of bits of each half byte.
inline Bytes count_bits(Bytes a, Bytes b, Bytes c, Bytes d) {
  const Bytes table = _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4,  //
                                       0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const Bytes twice = _mm256_add_epi8(table, table);
  const Bytes low = _mm256_set1_epi8(15);
  // Bits are added up first as far as two full adders go: a + b + c = ones + 2 twos.
  const Bytes unlike = _mm256_xor_si256(a, b);
  const Bytes ones = _mm256_xor_si256(unlike, c);
  const Bytes twos = _mm256_or_si256(_mm256_and_si256(a, b), _mm256_and_si256(unlike, c));
  Bytes sum = _mm256_shuffle_epi8(table, _mm256_and_si256(ones, low));
  sum = _mm256_add_epi8(
      sum, _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi16(ones, 4), low)));
  sum = _mm256_add_epi8(sum, _mm256_shuffle_epi8(twice, _mm256_and_si256(twos, low)));
  sum = _mm256_add_epi8(
      sum, _mm256_shuffle_epi8(twice, _mm256_and_si256(_mm256_srli_epi16(twos, 4), low)));
  sum = _mm256_add_epi8(sum, _mm256_shuffle_epi8(table, _mm256_and_si256(d, low)));
  return _mm256_add_epi8(
      sum, _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi16(d, 4), low)));
}

/// The same of two bytes, of which the second has its lower four alone.
inline Bytes count_bits(Bytes a, Bytes b) {
  const Bytes table = _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4,  //
                                       0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const Bytes low = _mm256_set1_epi8(15);
  const Bytes first =
      _mm256_add_epi8(_mm256_shuffle_epi8(table, _mm256_and_si256(a, low)),
                      _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi16(a, 4), low)));
  return _mm256_add_epi8(first, _mm256_shuffle_epi8(table, b));
}

/// Every byte's neighbour before it; that of the first is the last of `before`.
inline Bytes one_before(Bytes before, Bytes v) {
  return _mm256_alignr_epi8(v, _mm256_permute2x128_si256(before, v, 0x21), 15);
}
inline Bytes one_after(Bytes v, Bytes after) {
  return _mm256_alignr_epi8(_mm256_permute2x128_si256(v, after, 0x21), v, 1);
}

/// The least byte, everywhere.
inline Bytes spread_least(Bytes v) {
  const __m128i pairs = _mm_min_epu8(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  const __m128i words = _mm_min_epu8(pairs, _mm_srli_epi16(pairs, 8));
  return _mm256_broadcastb_epi8(_mm_minpos_epu16(words));
}
inline std::uint8_t lowest_byte(Bytes v) {
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(_mm256_castsi256_si128(v)));
}

inline Words load_words(const std::uint16_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}
inline void store_words(std::uint16_t* to, Words v) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), v);
}
inline Words load_signed(const std::int16_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}
inline void store_signed(std::int16_t* to, Words v) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), v);
}
inline Words spread_word(int v) { return _mm256_set1_epi16(static_cast<short>(v)); }
inline Words first_words() {
  return _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
inline Words add_words(Words a, Words b) { return _mm256_add_epi16(a, b); }
inline Words min_words(Words a, Words b) { return _mm256_min_epu16(a, b); }
inline Words min_signed(Words a, Words b) { return _mm256_min_epi16(a, b); }
inline Words max_signed(Words a, Words b) { return _mm256_max_epi16(a, b); }

/// Every word's neighbour after it; that of the last is the first of `after`.
inline Words word_after(Words v, Words after) {
  return _mm256_alignr_epi8(_mm256_permute2x128_si256(v, after, 0x21), v, 2);
}
inline int least_word(Words v) {
  const __m128i half = _mm_min_epu16(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  return _mm_cvtsi128_si32(_mm_minpos_epu16(half)) & 0xFFFF;
}

/// 64 (a + b) in words, the lower half of them first.
inline void sum_as_words(Bytes a, Bytes b, Words (&out)[2]) {
  const Bytes factor = _mm256_set1_epi8(64);
  const Words low = _mm256_maddubs_epi16(_mm256_unpacklo_epi8(a, b), factor);
  const Words high = _mm256_maddubs_epi16(_mm256_unpackhi_epi8(a, b), factor);
  out[0] = _mm256_permute2x128_si256(low, high, 0x20);
  out[1] = _mm256_permute2x128_si256(low, high, 0x31);
}
/// 64 (a + b + c + d), the same way.
inline void sum_as_words(Bytes a, Bytes b, Bytes c, Bytes d, Words (&out)[2]) {
  const Bytes factor = _mm256_set1_epi8(64);
  const Words low = _mm256_add_epi16(_mm256_maddubs_epi16(_mm256_unpacklo_epi8(a, b), factor),
                                     _mm256_maddubs_epi16(_mm256_unpacklo_epi8(c, d), factor));
  const Words high = _mm256_add_epi16(_mm256_maddubs_epi16(_mm256_unpackhi_epi8(a, b), factor),
                                      _mm256_maddubs_epi16(_mm256_unpackhi_epi8(c, d), factor));
  out[0] = _mm256_permute2x128_si256(low, high, 0x20);
  out[1] = _mm256_permute2x128_si256(low, high, 0x31);
}

}  // namespace
}  // namespace avoidbench::census

#include "sensing/census_kernels_body.hpp"

namespace avoidbench::census {

const Kernels& avx2_kernels() { return kKernels; }

}  // namespace avoidbench::census
