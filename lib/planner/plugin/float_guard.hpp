#pragma once

#include <cfenv>

namespace avoidbench {

/// While it lives, a planner's code may run: rounding, denormal numbers and traps are afterwards as
/// they were before. Libraries built with -ffast-math change them when they are loaded.
class FloatGuard {
 public:
  FloatGuard() { std::fegetenv(&environment_); }
  ~FloatGuard() { std::fesetenv(&environment_); }
  FloatGuard(const FloatGuard&) = delete;
  FloatGuard& operator=(const FloatGuard&) = delete;

 private:
  std::fenv_t environment_{};
};

}  // namespace avoidbench
