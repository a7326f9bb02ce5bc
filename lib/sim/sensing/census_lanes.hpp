#pragma once

#include "render/lanes.hpp"

/// What the census matcher needs of registers of bytes and words besides lanes.hpp: all that sees
/// more than one lane, and sums of bits.
namespace avoidbench::census {
namespace {

/// At most 255.
AB_LANE Bytes add_saturated(Bytes a, Bytes b) {
  return bits_as<Bytes>(AB_INTRINSIC(adds_epu8)(bits_as<Register>(a), bits_as<Register>(b)));
}

/// A register that begins kFrom bytes after the first of `a`, which `b` follows.
template <int kFrom, class Vector>
AB_LANE Vector part_of_both(Vector a, Vector b) {
  const auto first = bits_as<Register>(a);
  const auto second = bits_as<Register>(b);
#ifdef __AVX2__
  const Register between = _mm256_permute2x128_si256(first, second, 0x21);
  return bits_as<Vector>(kFrom < 16 ? _mm256_alignr_epi8(between, first, kFrom % 16)
                                    : _mm256_alignr_epi8(second, between, kFrom % 16));
#else
  return bits_as<Vector>(_mm_srli_si128(first, kFrom) | _mm_slli_si128(second, 16 - kFrom));
#endif
}

/// 255 in the last sixteen bytes.
AB_LANE Bytes last_sixteen() {
  return kBytes == 16 ? all_bytes(255) : part_of_both<16>(Bytes{}, all_bytes(255));
}

/// The least byte, everywhere.
AB_LANE Bytes spread_least(Bytes v) {
#ifdef __AVX2__
  const __m128i low = _mm256_castsi256_si128(bits_as<Register>(v));
  const __m128i pairs = _mm_min_epu8(low, _mm256_extracti128_si256(bits_as<Register>(v), 1));
  const __m128i words = _mm_min_epu8(pairs, _mm_srli_epi16(pairs, 8));
  return bits_as<Bytes>(_mm256_broadcastb_epi8(_mm_minpos_epu16(words)));
#else
  v = least(v, bits_as<Bytes>(_mm_shuffle_epi32(bits_as<Register>(v), 0x4E)));
  v = least(v, bits_as<Bytes>(_mm_shuffle_epi32(bits_as<Register>(v), 0xB1)));
  v = least(v, bits_as<Bytes>(bits_as<Ints>(v) >> 16 | bits_as<Ints>(v) << 16));
  return least(v, bits_as<Bytes>(bits_as<Words>(v) >> 8 | bits_as<Words>(v) << 8));
#endif
}

AB_LANE int least_word(Words v) {
#ifdef __AVX2__
  const __m128i low = _mm256_castsi256_si128(bits_as<Register>(v));
  const __m128i half = _mm_min_epu16(low, _mm256_extracti128_si256(bits_as<Register>(v), 1));
  return _mm_cvtsi128_si32(_mm_minpos_epu16(half)) & 0xFFFF;
#else
  v = least(v, bits_as<Words>(_mm_shuffle_epi32(bits_as<Register>(v), 0x4E)));
  v = least(v, bits_as<Words>(_mm_shuffle_epi32(bits_as<Register>(v), 0xB1)));
  return least(v, bits_as<Words>(bits_as<Ints>(v) >> 16))[0];
#endif
}

/// 64 (a + b) in words: of the lower or the upper half of each 16 bytes.
template <bool kUpper>
AB_LANE Words sum_of_half(Bytes a, Bytes b) {
  const auto words = [](Bytes x, Bytes y) {
    return kUpper ? AB_INTRINSIC(unpackhi_epi8)(bits_as<Register>(x), bits_as<Register>(y))
                  : AB_INTRINSIC(unpacklo_epi8)(bits_as<Register>(x), bits_as<Register>(y));
  };
#ifdef __AVX2__
  return bits_as<Words>(_mm256_maddubs_epi16(words(a, b), _mm256_set1_epi8(64)));
#else
  return (bits_as<Words>(words(a, Bytes{})) + bits_as<Words>(words(b, Bytes{}))) << 6;
#endif
}

/// Such sums in the order of their bytes.
AB_LANE void put_in_order([[maybe_unused]] Words& lower, [[maybe_unused]] Words& upper) {
#ifdef __AVX2__
  const auto low = bits_as<Register>(lower);
  const auto high = bits_as<Register>(upper);
  lower = bits_as<Words>(_mm256_permute2x128_si256(low, high, 0x20));
  upper = bits_as<Words>(_mm256_permute2x128_si256(low, high, 0x31));
#endif
}

/// Each byte moved down by kBits; what enters from the byte above is for a mask to remove.
template <int kBits>
AB_LANE Bytes moved_down(Bytes v) {
  return bits_as<Bytes>(bits_as<Words>(v) >> kBits);
}

#ifdef __AVX2__

/// Set bits of numbers below 16, times the factor.
AB_LANE Bytes bits_by_table(Bytes v, std::uint8_t factor) {
  const Bytes counts{0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4,
                     0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
  const auto table = bits_as<Register>(counts * factor);
  return bits_as<Bytes>(_mm256_shuffle_epi8(table, bits_as<Register>(v)));
}

/// Of whole bytes.
AB_LANE Bytes bits_of(Bytes v, std::uint8_t factor) {
  return bits_by_table(v & 15, factor) + bits_by_table(moved_down<4>(v) & 15, factor);
}

/// Set bits of four bytes together.
AB_LANE Bytes count_bits(Bytes a, Bytes b, Bytes c, Bytes d) {
  // Added up first as far as two full adders go: a + b + c = ones + 2 twos.
  const Bytes unlike = a ^ b;
  const Bytes ones = unlike ^ c;
  const Bytes twos = (a & b) | (unlike & c);
  return bits_of(ones, 1) + bits_of(twos, 2) + bits_of(d, 1);
}

/// The same of two bytes, of which the second has its lower four alone.
AB_LANE Bytes count_bits(Bytes a, Bytes b) { return bits_of(a, 1) + bits_by_table(b, 1); }

#else

/// Set bits of two bytes together by half bytes, at most 8 in each.
AB_LANE Bytes half_byte_bits(Bytes a, Bytes b) {
  const auto pairs = [](Bytes v) {
    const Bytes twos = v - (moved_down<1>(v) & 0x55);
    return (twos & 0x33) + (moved_down<2>(twos) & 0x33);
  };
  return pairs(a) + pairs(b);
}

AB_LANE Bytes count_bits(Bytes a, Bytes b, Bytes c, Bytes d) {
  const Bytes ab = half_byte_bits(a, b);
  const Bytes cd = half_byte_bits(c, d);
  return ((ab & 15) + (cd & 15)) + ((moved_down<4>(ab) & 15) + (moved_down<4>(cd) & 15));
}

AB_LANE Bytes count_bits(Bytes a, Bytes b) {
  const Bytes bits = half_byte_bits(a, b);
  return (bits & 15) + (moved_down<4>(bits) & 15);
}

#endif

}  // namespace
}  // namespace avoidbench::census
