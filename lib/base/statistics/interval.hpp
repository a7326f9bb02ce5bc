#pragma once

namespace avoidbench {

/// An interval of confidence, both ends within it. NaN where it is not defined, infinite where it
/// has no end.
struct Interval {
  double lower = 0.0, upper = 0.0;
};

}  // namespace avoidbench
