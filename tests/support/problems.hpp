#pragma once

#include <functional>
#include <string>

#include "base/input_error.hpp"

namespace avoidbench {

/// The printed problems of the InputError that `action` throws, one a line; "" where it throws
/// none.
inline std::string problems_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The problems, one a line, as main prints them.
inline std::string joined(const std::vector<InputProblem>& problems) {
  std::string all;
  for (const InputProblem& problem : problems) all += (all.empty() ? "" : "\n") + text(problem);
  return all;
}

}  // namespace avoidbench
