#include "avoidbench/portable_math.hpp"

#include "avoidbench/planner.h"

/// For avoidbench/portable_math.py, by ctypes.
extern "C" {
AB_EXPORT double portable_sin(double x) { return avoidbench::portable::sin(x); }
AB_EXPORT double portable_cos(double x) { return avoidbench::portable::cos(x); }
AB_EXPORT double portable_tan(double x) { return avoidbench::portable::tan(x); }
AB_EXPORT double portable_asin(double x) { return avoidbench::portable::asin(x); }
AB_EXPORT double portable_acos(double x) { return avoidbench::portable::acos(x); }
AB_EXPORT double portable_atan(double x) { return avoidbench::portable::atan(x); }
AB_EXPORT double portable_atan2(double y, double x) { return avoidbench::portable::atan2(y, x); }
AB_EXPORT double portable_exp(double x) { return avoidbench::portable::exp(x); }
AB_EXPORT double portable_log(double x) { return avoidbench::portable::log(x); }
}
