#pragma once

#include <string>

#include "base/input_error.hpp"

namespace avoidbench::test {

/// The message of the InputError that `action` throws; "no error" if it throws none.
template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

inline bool has(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

}  // namespace avoidbench::test
