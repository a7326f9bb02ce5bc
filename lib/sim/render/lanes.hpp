#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

/// What the kernels of depth, shading and stereo matching compute with: registers of numbers, 16
/// bytes on every x86-64 machine (SSE2), 32 in a file compiled with -mavx2. They are the compilers'
/// vectors: + - * / & | ^ << >> and comparisons work lane by lane, also with one number for all
/// lanes; a ? b : c chooses lane by lane. What these can't say is in intrinsics here and, for
/// bytes, in sensing/census_lanes.hpp; kernels have none.
///
/// Each kernel is one source that two files include, of which one is compiled for AVX2; has_avx2()
/// chooses. Both give the same bits, because all operations are IEEE's or on integers. All is in
/// an unnamed namespace, and kernels include neither the standard library's functions nor Eigen:
/// a function compiled for AVX2 must never be the one that the linker keeps for every file.
namespace avoidbench {
namespace {

#define AB_LANE [[gnu::always_inline]] inline

#ifdef __AVX2__
constexpr int kRegisterBytes = 32;
#define AB_INTRINSIC(name) _mm256_##name
#else
constexpr int kRegisterBytes = 16;
#define AB_INTRINSIC(name) _mm_##name
#endif

using Floats [[gnu::vector_size(kRegisterBytes)]] = float;
using Doubles [[gnu::vector_size(kRegisterBytes)]] = double;
using Ints [[gnu::vector_size(kRegisterBytes)]] = std::uint32_t;
using Mask [[gnu::vector_size(kRegisterBytes)]] = std::int32_t;  ///< in each lane all bits or none
using Words [[gnu::vector_size(kRegisterBytes)]] = std::uint16_t;
using SignedWords [[gnu::vector_size(kRegisterBytes)]] = std::int16_t;
using Bytes [[gnu::vector_size(kRegisterBytes)]] = std::uint8_t;
using Register [[gnu::vector_size(kRegisterBytes)]] = long long;  ///< as intrinsics take integers

constexpr int kBytes = kRegisterBytes;        ///< 16 or 32
constexpr int kWords = kRegisterBytes / 2;    ///< 8 or 16
constexpr int kLanes = kRegisterBytes / 4;    ///< of Floats, Ints and Mask: 4 or 8
constexpr int kDoubles = kRegisterBytes / 8;  ///< 2 or 4

// What all kernels need.

template <class Vector, class Number>
AB_LANE Vector load(const Number* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <class Number, class Vector>
AB_LANE void store(Number* to, Vector v) {
  __builtin_memcpy(to, &v, sizeof v);
}

template <class Vector, class From>
AB_LANE Vector bits_as(From v) {
  return __builtin_bit_cast(Vector, v);
}

// Less zeros: x + 0 would lose the sign of -0.
AB_LANE Floats all_lanes(float x) { return x - Floats{}; }
AB_LANE Doubles all_lanes(double x) { return x - Doubles{}; }
AB_LANE Ints all_lanes(std::uint32_t x) { return x - Ints{}; }
AB_LANE Words all_words(std::uint16_t x) { return x - Words{}; }
AB_LANE Bytes all_bytes(std::uint8_t x) { return x - Bytes{}; }

template <class Vector>
AB_LANE Vector least(Vector a, Vector b) {
  return a < b ? a : b;
}
template <class Vector>
AB_LANE Vector greatest(Vector a, Vector b) {
  return a > b ? a : b;
}
// Where g++ 12 finds no single instruction: beside constants, and for words in SSE2.
AB_LANE Floats least(Floats a, Floats b) { return AB_INTRINSIC(min_ps)(a, b); }
AB_LANE Floats greatest(Floats a, Floats b) { return AB_INTRINSIC(max_ps)(a, b); }
#ifndef __AVX2__
AB_LANE Words least(Words a, Words b) {
  return a - bits_as<Words>(_mm_subs_epu16(bits_as<Register>(a), bits_as<Register>(b)));
}
#endif

AB_LANE Floats least(Floats a, float b) { return least(a, all_lanes(b)); }
AB_LANE Floats greatest(Floats a, float b) { return greatest(a, all_lanes(b)); }
AB_LANE Floats within_unit(Floats x) { return least(greatest(x, 0.0F), 1.0F); }
AB_LANE Floats square_root(Floats x) { return AB_INTRINSIC(sqrt_ps)(x); }
AB_LANE Ints towards_zero(Floats x) { return bits_as<Ints>(__builtin_convertvector(x, Mask)); }
AB_LANE Floats to_floats(Ints x) { return __builtin_convertvector(bits_as<Mask>(x), Floats); }
AB_LANE Floats magnitude(Floats x) { return bits_as<Floats>(bits_as<Ints>(x) & 0x7fffffffU); }

/// Sign by sign: x where `sign_of` is positive, else -x.
AB_LANE Floats turned(Floats x, Floats sign_of) {
  return bits_as<Floats>(bits_as<Ints>(x) ^ (bits_as<Ints>(sign_of) & 0x80000000U));
}

/// Of each lane's two signed halves, each multiplied: the sum. The one multiplication of integers
/// that SSE2 has and that reaches 32 bits.
AB_LANE Ints products_of_halves(Ints a, Ints b) {
  return bits_as<Ints>(AB_INTRINSIC(madd_epi16)(bits_as<Register>(a), bits_as<Register>(b)));
}

/// A bit a lane.
AB_LANE unsigned lane_bits(Mask mask) {
  return static_cast<unsigned>(AB_INTRINSIC(movemask_ps)(bits_as<Floats>(mask)));
}
AB_LANE bool any(Mask mask) { return lane_bits(mask) != 0; }

/// The lanes whose bit is set.
AB_LANE Mask mask_of(unsigned bits) {
#ifdef __AVX2__
  const Ints lane{1, 2, 4, 8, 16, 32, 64, 128};
#else
  const Ints lane{1, 2, 4, 8};
#endif
  return (bits & lane) == lane;
}

AB_LANE Floats select(Mask mask, Floats yes, Floats no) { return mask ? yes : no; }
AB_LANE Ints select(Mask mask, Ints yes, Ints no) { return mask ? yes : no; }

/// A number as floor(x) and the rest in [0, 1); |x| < 2³¹.
struct Split {
  Ints whole;
  Floats rest;
};

AB_LANE Split split(Floats x) {
#ifdef __AVX2__
  const Floats floor = _mm256_floor_ps(x);
  return {towards_zero(floor), x - floor};
#else
  const Ints toward_zero = towards_zero(x);
  const Floats whole = to_floats(toward_zero);
  const Ints step = bits_as<Ints>(x < whole);  // -1 where below
  return {toward_zero + step, x - (whole + to_floats(step))};
#endif
}

/// Rounded to nearest: half of the lanes of the one, half of the other.
AB_LANE Floats to_floats(Doubles first, Doubles second) {
#ifdef __AVX2__
  return _mm256_set_m128(_mm256_cvtpd_ps(second), _mm256_cvtpd_ps(first));
#else
  return _mm_movelh_ps(_mm_cvtpd_ps(first), _mm_cvtpd_ps(second));
#endif
}

}  // namespace
}  // namespace avoidbench
