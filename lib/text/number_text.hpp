#pragma once

#include <string>

namespace avoidbench {

// Numbers as text, the same whatever locale a planner or a library has set, at any time, in any
// thread: printf, streams and std::to_string write a comma where the locale has one.

/// The number with the fewest digits that read back to the same bits; `nan`, `inf`, `-inf`.
std::string shortest(double value);

/// As printf's %.*f: so many digits after the point.
std::string fixed_digits(double value, int decimals);

/// As printf's %.*g: so many significant digits, without zeros at the end.
std::string significant_digits(double value, int digits);

}  // namespace avoidbench
