#pragma once

#include <string>
#include <vector>

#include "base/input_error.hpp"

namespace avoidbench::test {

/// The message of the InputError that `action` throws, its problems one a line; "" if it throws
/// none.
template <class Action>
std::string message_of(Action action) {
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

inline bool has(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

}  // namespace avoidbench::test
