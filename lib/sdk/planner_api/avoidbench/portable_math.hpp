/* Elementary functions that give the same bits on every x86-64 machine, for planners whose flights
 * should not depend on the processor at hand: the C library chooses between variants with and
 * without fused multiply-add. Header-only, C++17.
 *
 * SPDX-License-Identifier: MIT
 * This header may be used in and linked with planners under any licence, closed ones too.
 *
 * Minimax polynomials and argument reductions of FDLIBM 5.3:
 * Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunSoft, a Sun
 * Microsystems, Inc. business. Permission to use, copy, modify, and distribute this software is
 * freely granted, provided that this notice is preserved.
 *
 * Errors stay below 1.5 ulp; tan, asin and acos 3 ulp; pow is good to 1e-13. sin and cos are NaN
 * beyond 1e6 rad. sqrt, fabs, floor, ceil, round and fmod of <cmath> are exact everywhere and not
 * repeated here. Compile with -ffp-contract=off.
 */
#ifndef AVOIDBENCH_PORTABLE_MATH_HPP
#define AVOIDBENCH_PORTABLE_MATH_HPP

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace avoidbench::portable {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTau = 6.28318530717958647692;

namespace detail {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// sin(x + tail) for |x| <= π/4.
inline double kernel_sin(double x, double tail) {
  const double z = x * x;
  const double v = z * x;
  const double r = 8.33333333332248946124e-03 +
                   z * (-1.98412698298579493134e-04 +
                        z * (2.75573137070700676789e-06 +
                             z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  return x - ((z * (0.5 * tail - v * r) - tail) - v * -1.66666666666666324348e-01);
}

/// cos(x + tail) for |x| <= π/4.
inline double kernel_cos(double x, double tail) {
  const double z = x * x;
  const double r =
      z * (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const double half = 0.5 * z;
  const double w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z * r - x * tail));
}

struct Reduced {
  double x, tail;
  int quadrant;
};

/// x = quadrant · π/2 + (x + tail), by three parts of π/2 of 33 bits each (Cody and Waite).
inline Reduced reduce(double x) {
  constexpr double kTwoOverPi = 6.36619772367581382433e-01;
  constexpr double kPart1 = 1.57079632673412561417e+00, kPart1Tail = 6.07710050650619224932e-11;
  constexpr double kPart2 = 6.07710050630396597660e-11, kPart2Tail = 2.02226624879595063154e-21;
  constexpr double kPart3 = 2.02226624871116645580e-21, kPart3Tail = 8.47842766036889956997e-32;
  const double n = std::nearbyint(x * kTwoOverPi);
  double r = x - n * kPart1;
  double w = n * kPart1Tail;
  double y = r - w;
  const auto exponent = [](double v) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    return (bits >> 52U) & 0x7ffU;
  };
  const int exponent_x = static_cast<int>(exponent(x));
  if (exponent_x - static_cast<int>(exponent(y)) > 16) {  // cancelled: bring in the second part
    double t = r;
    w = n * kPart2;
    r = t - w;
    w = n * kPart2Tail - ((t - r) - w);
    y = r - w;
    if (exponent_x - static_cast<int>(exponent(y)) > 49) {
      t = r;
      w = n * kPart3;
      r = t - w;
      w = n * kPart3Tail - ((t - r) - w);
      y = r - w;
    }
  }
  return {y, (r - y) - w, static_cast<int>(static_cast<std::int64_t>(n) & 3)};
}

inline bool is_small(double x) { return std::abs(x) <= kPi / 4; }

}  // namespace detail

inline double sin(double x) {
  if (detail::is_small(x)) return detail::kernel_sin(x, 0.0);
  if (!(std::abs(x) <= 1e6)) return detail::kNaN;
  const detail::Reduced r = detail::reduce(x);
  const double value =
      (r.quadrant & 1) != 0 ? detail::kernel_cos(r.x, r.tail) : detail::kernel_sin(r.x, r.tail);
  return (r.quadrant & 2) != 0 ? -value : value;
}

inline double cos(double x) {
  if (detail::is_small(x)) return detail::kernel_cos(x, 0.0);
  if (!(std::abs(x) <= 1e6)) return detail::kNaN;
  const detail::Reduced r = detail::reduce(x);
  const double value =
      (r.quadrant & 1) != 0 ? detail::kernel_sin(r.x, r.tail) : detail::kernel_cos(r.x, r.tail);
  return r.quadrant == 1 || r.quadrant == 2 ? -value : value;
}

inline double tan(double x) {
  const double s = sin(x);
  return s / cos(x);
}

inline double atan(double x) {
  constexpr double kHigh[] = {4.63647609000806093515e-01, 7.85398163397448278999e-01,
                              9.82793723247329054082e-01, 1.57079632679489655800e+00};
  constexpr double kLow[] = {2.26987774529616870924e-17, 3.06161699786838301793e-17,
                             1.39033110312309984516e-17, 6.12323399573676603587e-17};
  if (std::isnan(x)) return x;
  const double size = std::abs(x);
  if (size >= 0x1p66) return std::copysign(kHigh[3] + kLow[3], x);
  int part = -1;
  double y = size;
  if (size >= 0.4375) {
    if (size < 0.6875) {
      part = 0;
      y = (2.0 * size - 1.0) / (2.0 + size);
    } else if (size < 1.1875) {
      part = 1;
      y = (size - 1.0) / (size + 1.0);
    } else if (size < 2.4375) {
      part = 2;
      y = (size - 1.5) / (1.0 + 1.5 * size);
    } else {
      part = 3;
      y = -1.0 / size;
    }
  }
  const double z = y * y;
  const double w = z * z;
  const double odd =
      z * (3.33333333333329318027e-01 +
           w * (1.42857142725034663711e-01 +
                w * (9.09088713343650656196e-02 +
                     w * (6.66107313738753120669e-02 +
                          w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double even =
      w * (-1.99999999998764832476e-01 +
           w * (-1.11111104054623557880e-01 +
                w * (-7.69187620504482999495e-02 +
                     w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  const double value =
      part < 0 ? y - y * (odd + even) : kHigh[part] - ((y * (odd + even) - kLow[part]) - y);
  return std::copysign(value, x);
}

inline double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return detail::kNaN;
  constexpr double kPiLow = 1.2246467991473531772e-16;
  if (y == 0.0) return std::signbit(x) ? std::copysign(kPi, y) : y;
  if (x == 0.0) return std::copysign(kPi / 2, y);
  if (std::isinf(x) || std::isinf(y)) {
    const double toward_x = std::isinf(x) ? (x > 0 ? 0.0 : kPi) : kPi / 2;
    const double both = x > 0 ? kPi / 4 : 3 * (kPi / 4);
    return std::copysign(std::isinf(x) && std::isinf(y) ? both : toward_x, y);
  }
  const double angle = atan(std::abs(y / x));
  return std::copysign(x > 0 ? angle : kPi - (angle - kPiLow), y);
}

inline double asin(double x) { return atan2(x, std::sqrt((1.0 - x) * (1.0 + x))); }

inline double acos(double x) { return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x); }

inline double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 7.09782712893383973096e+02) return detail::kInfinity;
  if (x < -7.45133219101941108420e+02) return 0.0;
  constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
  const double k =
      std::abs(x) > 0.34657359027997264 ? std::nearbyint(x * 1.44269504088896338700) : 0.0;
  const double high = x - k * kLn2High;
  const double low = k * kLn2Low;
  const double r = high - low;
  const double t = r * r;
  const double c =
      r - t * (1.66666666666666019037e-01 +
               t * (-2.77777777770155933842e-03 +
                    t * (6.61375632143793436117e-05 +
                         t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))));
  const double y = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
  return std::ldexp(y, static_cast<int>(k));
}

inline double log(double x) {
  if (std::isnan(x) || x < 0.0) return detail::kNaN;
  if (x == 0.0) return -detail::kInfinity;
  if (std::isinf(x)) return x;
  int k = 0;
  double m = std::frexp(x, &k);  // [0.5, 1)
  if (m < 0.70710678118654752440) {
    m *= 2.0;
    --k;
  }
  constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double w = z * z;
  const double even = w * (3.999999999940941908e-01 +
                           w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double odd = z * (6.666666666666735130e-01 +
                          w * (2.857142874366239149e-01 +
                               w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double half_square = 0.5 * f * f;
  const double n = k;
  return n * kLn2High - ((half_square - (s * (half_square + even + odd) + n * kLn2Low)) - f);
}

inline double pow(double base, double exponent) { return exp(exponent * log(base)); }

inline double hypot(double x, double y) { return std::sqrt(x * x + y * y); }

/// The angle in (-pi, pi] that differs from `angle_rad` by whole turns.
inline double wrapped_angle(double angle_rad) {
  const double wrapped = angle_rad - kTau * std::ceil((angle_rad - kPi) / kTau);
  return wrapped;
}

}  // namespace avoidbench::portable

#endif
