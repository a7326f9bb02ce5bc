#pragma once

#include <immintrin.h>

#include <cstdint>

/// Eight lanes of float or int32, one a ray of a packet, or four of double: two SSE2 registers, or
/// one of AVX2 in a file compiled with -mavx2. Only operations that IEEE defines (or that are
/// exact), so that both give the same bits. In an unnamed namespace, as is everything made of it: a
/// function compiled with -mavx2 must never be the one that the linker keeps for every file.
namespace avoidbench {
namespace {

#define AB_LANE [[gnu::always_inline]] inline

// NOLINTBEGIN(bugprone-macro-parentheses): types and names cannot stand in parentheses
#ifdef __AVX2__
#define AB_LANES_MEMBERS(whole, half) whole all
#define AB_UNARY(type, name, from, sse, avx) \
  AB_LANE type name(from a) { return type{avx(a.all)}; }
#define AB_BINARY(type, name, from, sse, avx) \
  AB_LANE type name(from a, from b) { return type{avx(a.all, b.all)}; }
#else
#define AB_LANES_MEMBERS(whole, half) half low, high
#define AB_UNARY(type, name, from, sse, avx) \
  AB_LANE type name(from a) { return type{sse(a.low), sse(a.high)}; }
#define AB_BINARY(type, name, from, sse, avx) \
  AB_LANE type name(from a, from b) { return type{sse(a.low, b.low), sse(a.high, b.high)}; }
#endif
// NOLINTEND(bugprone-macro-parentheses)

/// All bits of a lane are set, or none.
struct Mask {
  AB_LANES_MEMBERS(__m256, __m128);
};
struct Floats {
  AB_LANES_MEMBERS(__m256, __m128);
};
struct Ints {
  AB_LANES_MEMBERS(__m256i, __m128i);
};
/// Four lanes only.
struct Doubles {
  AB_LANES_MEMBERS(__m256d, __m128d);
};

AB_LANE Floats all_lanes(float x) {
#ifdef __AVX2__
  return {_mm256_set1_ps(x)};
#else
  return {_mm_set1_ps(x), _mm_set1_ps(x)};
#endif
}

AB_LANE Ints all_lanes(std::uint32_t x) {
  const int bits = static_cast<int>(x);
#ifdef __AVX2__
  return {_mm256_set1_epi32(bits)};
#else
  return {_mm_set1_epi32(bits), _mm_set1_epi32(bits)};
#endif
}

AB_LANE Doubles all_lanes(double x) {
#ifdef __AVX2__
  return {_mm256_set1_pd(x)};
#else
  return {_mm_set1_pd(x), _mm_set1_pd(x)};
#endif
}

AB_BINARY(Doubles, operator+, Doubles, _mm_add_pd, _mm256_add_pd)
AB_BINARY(Doubles, operator*, Doubles, _mm_mul_pd, _mm256_mul_pd)
AB_BINARY(Floats, operator+, Floats, _mm_add_ps, _mm256_add_ps)
AB_BINARY(Floats, operator-, Floats, _mm_sub_ps, _mm256_sub_ps)
AB_BINARY(Floats, operator*, Floats, _mm_mul_ps, _mm256_mul_ps)
AB_BINARY(Floats, operator/, Floats, _mm_div_ps, _mm256_div_ps)
AB_BINARY(Floats, least, Floats, _mm_min_ps, _mm256_min_ps)
AB_BINARY(Floats, greatest, Floats, _mm_max_ps, _mm256_max_ps)
AB_UNARY(Floats, square_root, Floats, _mm_sqrt_ps, _mm256_sqrt_ps)

AB_LANE Floats operator+(Floats a, float b) { return a + all_lanes(b); }
AB_LANE Floats operator-(Floats a, float b) { return a - all_lanes(b); }
AB_LANE Floats operator*(Floats a, float b) { return a * all_lanes(b); }
AB_LANE Floats operator+(float a, Floats b) { return all_lanes(a) + b; }
AB_LANE Floats operator-(float a, Floats b) { return all_lanes(a) - b; }
AB_LANE Floats operator*(float a, Floats b) { return all_lanes(a) * b; }
AB_LANE Floats operator/(float a, Floats b) { return all_lanes(a) / b; }
AB_LANE Floats least(Floats a, float b) { return least(a, all_lanes(b)); }
AB_LANE Floats greatest(Floats a, float b) { return greatest(a, all_lanes(b)); }
AB_LANE Floats within_unit(Floats x) { return least(greatest(x, 0.0F), 1.0F); }

AB_BINARY(Mask, operator&, Mask, _mm_and_ps, _mm256_and_ps)
AB_BINARY(Mask, operator|, Mask, _mm_or_ps, _mm256_or_ps)
AB_BINARY(Ints, operator+, Ints, _mm_add_epi32, _mm256_add_epi32)
AB_BINARY(Ints, operator^, Ints, _mm_xor_si128, _mm256_xor_si256)
AB_BINARY(Ints, operator&, Ints, _mm_and_si128, _mm256_and_si256)
/// Of each lane's two signed halves, each multiplied: the sum. The one multiplication of integers
/// that SSE2 has and that reaches 32 bits.
AB_BINARY(Ints, products_of_halves, Ints, _mm_madd_epi16, _mm256_madd_epi16)
AB_UNARY(Ints, towards_zero, Floats, _mm_cvttps_epi32, _mm256_cvttps_epi32)
AB_UNARY(Floats, to_floats, Ints, _mm_cvtepi32_ps, _mm256_cvtepi32_ps)
AB_UNARY(Floats, bits_as_floats, Ints, _mm_castsi128_ps, _mm256_castsi256_ps)
AB_UNARY(Ints, bits_as_ints, Floats, _mm_castps_si128, _mm256_castps_si256)

template <int kBits>
AB_LANE Ints shifted_right(Ints x) {
#ifdef __AVX2__
  return {_mm256_srli_epi32(x.all, kBits)};
#else
  return {_mm_srli_epi32(x.low, kBits), _mm_srli_epi32(x.high, kBits)};
#endif
}

template <int kBits>
AB_LANE Ints shifted_left(Ints x) {
#ifdef __AVX2__
  return {_mm256_slli_epi32(x.all, kBits)};
#else
  return {_mm_slli_epi32(x.low, kBits), _mm_slli_epi32(x.high, kBits)};
#endif
}

AB_LANE Mask operator<(Floats a, Floats b) {
#ifdef __AVX2__
  return {_mm256_cmp_ps(a.all, b.all, _CMP_LT_OS)};
#else
  return {_mm_cmplt_ps(a.low, b.low), _mm_cmplt_ps(a.high, b.high)};
#endif
}

AB_LANE Mask operator<=(Floats a, Floats b) {
#ifdef __AVX2__
  return {_mm256_cmp_ps(a.all, b.all, _CMP_LE_OS)};
#else
  return {_mm_cmple_ps(a.low, b.low), _mm_cmple_ps(a.high, b.high)};
#endif
}

/// A bit a lane.
AB_LANE unsigned lane_bits(Mask mask) {
#ifdef __AVX2__
  return static_cast<unsigned>(_mm256_movemask_ps(mask.all));
#else
  return static_cast<unsigned>(_mm_movemask_ps(mask.low) | _mm_movemask_ps(mask.high) << 4);
#endif
}

AB_LANE Mask operator==(Ints a, Ints b) {
#ifdef __AVX2__
  return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.all, b.all))};
#else
  return {_mm_castsi128_ps(_mm_cmpeq_epi32(a.low, b.low)),
          _mm_castsi128_ps(_mm_cmpeq_epi32(a.high, b.high))};
#endif
}

AB_LANE bool any(Mask mask) { return lane_bits(mask) != 0; }

/// The lanes whose bit is set.
AB_LANE Mask mask_of(unsigned bits) {
  const auto all = static_cast<int>(bits);
#ifdef __AVX2__
  const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i of_lane = _mm256_and_si256(_mm256_set1_epi32(all), lane);
  return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(of_lane, lane))};
#else
  const __m128i low = _mm_setr_epi32(1, 2, 4, 8);
  const __m128i high = _mm_setr_epi32(16, 32, 64, 128);
  const __m128i bit = _mm_set1_epi32(all);
  return {_mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(bit, low), low)),
          _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(bit, high), high))};
#endif
}

AB_LANE Floats select(Mask mask, Floats yes, Floats no) {
#ifdef __AVX2__
  return {_mm256_blendv_ps(no.all, yes.all, mask.all)};
#else
  return {_mm_or_ps(_mm_and_ps(mask.low, yes.low), _mm_andnot_ps(mask.low, no.low)),
          _mm_or_ps(_mm_and_ps(mask.high, yes.high), _mm_andnot_ps(mask.high, no.high))};
#endif
}

AB_LANE Ints select(Mask mask, Ints yes, Ints no) {
  return bits_as_ints(select(mask, bits_as_floats(yes), bits_as_floats(no)));
}

AB_LANE Floats magnitude(Floats x) {
  return bits_as_floats(bits_as_ints(x) & all_lanes(0x7fffffffU));
}

/// Sign by sign: x where `sign_of` is positive, else -x.
AB_LANE Floats turned(Floats x, Floats sign_of) {
  return bits_as_floats(bits_as_ints(x) ^ (bits_as_ints(sign_of) & all_lanes(0x80000000U)));
}

/// A number as floor(x) and the rest in [0, 1); |x| < 2³¹.
struct Split {
  Ints whole;
  Floats rest;
};

AB_LANE Split split(Floats x) {
#ifdef __AVX2__
  const __m256 floor = _mm256_floor_ps(x.all);
  return {{_mm256_cvttps_epi32(floor)}, {_mm256_sub_ps(x.all, floor)}};
#else
  const Ints toward_zero = towards_zero(x);
  const Floats whole = to_floats(toward_zero);
  const Mask below = x < whole;
  const Ints step{_mm_castps_si128(below.low), _mm_castps_si128(below.high)};  // -1 where below
  return {toward_zero + step, x - (whole + to_floats(step))};
#endif
}

/// Eight floats, at a multiple of 32 bytes.
AB_LANE Floats load(const float* from) {
#ifdef __AVX2__
  return {_mm256_load_ps(from)};
#else
  return {_mm_load_ps(from), _mm_load_ps(from + 4)};
#endif
}

AB_LANE void store(float* to, Floats x) {
#ifdef __AVX2__
  _mm256_store_ps(to, x.all);
#else
  _mm_store_ps(to, x.low);
  _mm_store_ps(to + 4, x.high);
#endif
}

/// Four floats, twice.
AB_LANE Floats load_four_twice(const float* from) {
  const __m128 four = _mm_loadu_ps(from);
#ifdef __AVX2__
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(four), four, 1)};
#else
  return {four, four};
#endif
}

/// Four lanes of the one, four of the other.
AB_LANE Floats four_each(float first, float second) {
  const __m128 low = _mm_set1_ps(first);
  const __m128 high = _mm_set1_ps(second);
#ifdef __AVX2__
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1)};
#else
  return {low, high};
#endif
}

/// Eight integers, at a multiple of 32 bytes.
AB_LANE Ints load(const std::uint32_t* from) {
#ifdef __AVX2__
  return {_mm256_load_si256(reinterpret_cast<const __m256i*>(from))};
#else
  const auto* at = reinterpret_cast<const __m128i*>(from);
  return {_mm_load_si128(at), _mm_load_si128(at + 1)};
#endif
}

/// The first four lanes to one place, the others to another.
AB_LANE void store_halves(float* first, float* second, Floats x) {
#ifdef __AVX2__
  _mm_storeu_ps(first, _mm256_castps256_ps128(x.all));
  _mm_storeu_ps(second, _mm256_extractf128_ps(x.all, 1));
#else
  _mm_storeu_ps(first, x.low);
  _mm_storeu_ps(second, x.high);
#endif
}

AB_LANE void store_halves(std::uint32_t* first, std::uint32_t* second, Ints x) {
  // The intrinsics may write to anything.
  store_halves(reinterpret_cast<float*>(first), reinterpret_cast<float*>(second),
               bits_as_floats(x));
}

/// Four doubles.
AB_LANE Doubles load_four(const double* from) {
#ifdef __AVX2__
  return {_mm256_loadu_pd(from)};
#else
  return {_mm_loadu_pd(from), _mm_loadu_pd(from + 2)};
#endif
}

AB_LANE void store_four(double* to, Doubles x) {
#ifdef __AVX2__
  _mm256_storeu_pd(to, x.all);
#else
  _mm_storeu_pd(to, x.low);
  _mm_storeu_pd(to + 2, x.high);
#endif
}

/// The fourth lane of the one, the others of the other.
AB_LANE Doubles fourth_from(Doubles fourth, Doubles others) {
#ifdef __AVX2__
  return {_mm256_blend_pd(others.all, fourth.all, 8)};
#else
  return {others.low, _mm_shuffle_pd(others.high, fourth.high, 2)};
#endif
}

/// Rounded to nearest: four lanes of the one, four of the other.
AB_LANE Floats to_floats(Doubles first, Doubles second) {
#ifdef __AVX2__
  return {_mm256_set_m128(_mm256_cvtpd_ps(second.all), _mm256_cvtpd_ps(first.all))};
#else
  return {_mm_movelh_ps(_mm_cvtpd_ps(first.low), _mm_cvtpd_ps(first.high)),
          _mm_movelh_ps(_mm_cvtpd_ps(second.low), _mm_cvtpd_ps(second.high))};
#endif
}

#undef AB_LANES_MEMBERS
#undef AB_UNARY
#undef AB_BINARY

}  // namespace
}  // namespace avoidbench
