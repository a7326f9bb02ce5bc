#include "base/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace avoidbench {

/// A mistake of the program, not of its input: nobody could go on from it, so it is no exception.
void fail_check(const char* expression, const char* file, int line, const std::string& values) {
  std::fprintf(stderr, "%s:%d: internal error: %s does not hold:%s\n", file, line, expression,
               values.c_str());
  std::abort();
}

}  // namespace avoidbench
