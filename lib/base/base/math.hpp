#pragma once

#include <limits>

/// Elementary functions that give the same bits on every x86-64 machine. The C library chooses
/// between variants with and without fused multiply-add by the processor at hand, so that its sin
/// and exp differ in the last bit from machine to machine and from version to version; lib/ uses
/// these instead (scripts/check_layers.py sees to it). Errors stay below 1.5 ulp where not said
/// otherwise. sqrt, fabs, floor, round, fmod are exact in IEEE and taken from <cmath>. They are
/// those that planners get from avoidbench/portable_math.hpp.
namespace avoidbench::math {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTau = 6.28318530717958647692;
inline constexpr double kDegree = kPi / 180.0;
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double sin(double x);  ///< |x| <= 1e6 rad; NaN beyond, where the reduction would lose bits
double cos(double x);  ///< as sin
double tan(double x);  ///< sin / cos: 3 ulp
double atan(double x);
double atan2(double y, double x);
double asin(double x);  ///< by atan2: 3 ulp; NaN outside [-1, 1]
double acos(double x);  ///< by atan2: 3 ulp; NaN outside [-1, 1]
double exp(double x);
double log(double x);
/// For base > 0: exp(exponent log(base)), with a relative error of 1e-13 for |result| near 1.
double pow(double base, double exponent);
double hypot(double x, double y);  ///< sqrt(x² + y²) without care for overflow

/// The angle in (-π, π] that differs from `angle_rad` by whole turns.
double wrapped_angle(double angle_rad);

}  // namespace avoidbench::math
