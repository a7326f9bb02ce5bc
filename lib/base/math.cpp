#include "base/math.hpp"

#include "avoidbench/portable_math.hpp"

namespace avoidbench::math {

double sin(double x) { return portable::sin(x); }
double cos(double x) { return portable::cos(x); }
double tan(double x) { return portable::tan(x); }
double atan(double x) { return portable::atan(x); }
double atan2(double y, double x) { return portable::atan2(y, x); }
double asin(double x) { return portable::asin(x); }
double acos(double x) { return portable::acos(x); }
double exp(double x) { return portable::exp(x); }
double log(double x) { return portable::log(x); }
double pow(double base, double exponent) { return portable::pow(base, exponent); }
double hypot(double x, double y) { return portable::hypot(x, y); }
double wrapped_angle(double angle_rad) { return portable::wrapped_angle(angle_rad); }

}  // namespace avoidbench::math
