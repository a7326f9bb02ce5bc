#pragma once

#include <sstream>
#include <string>

namespace avoidbench {

/// Prints the broken promise with its place and aborts: for our own errors, never for the user's or
/// a planner's.
[[noreturn]] void fail_check(const char* expression, const char* file, int line,
                             const std::string& values);

}  // namespace avoidbench

/// Aborts when `condition` is false; further arguments are printed. Never compiled out.
#define AB_CHECK(condition, ...)                                                       \
  do {                                                                                 \
    if (!(condition)) {                                                                \
      std::ostringstream ab_check_values;                                              \
      ::avoidbench::detail::print_values(ab_check_values __VA_OPT__(, ) __VA_ARGS__);  \
      ::avoidbench::fail_check(#condition, __FILE__, __LINE__, ab_check_values.str()); \
    }                                                                                  \
  } while (false)

namespace avoidbench::detail {

template <class... Values>
void print_values(std::ostringstream& out, const Values&... values) {
  ((out << ' ' << values), ...);
}

}  // namespace avoidbench::detail
