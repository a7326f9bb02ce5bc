#pragma once

#include <string>
#include <utility>

#include "base/input_error.hpp"

namespace avoidbench {

/// An InputError about an option of the command line, or that one would help with. Messages do not
/// name options: they have names of the program's, which it adds in its own spelling.
class OptionError : public InputError {
 public:
  /// `option`: what the message's beginning is the value of, such as "where"; "": none.
  /// `hint`: what would help, such as "library"; "": nothing.
  explicit OptionError(InputProblem problem, std::string option, std::string hint = {})
      : InputError(std::move(problem)), option_(std::move(option)), hint_(std::move(hint)) {}
  explicit OptionError(std::string message, std::string option, std::string hint = {})
      : OptionError(InputProblem{.file = {}, .message = std::move(message)}, std::move(option),
                    std::move(hint)) {}
  const std::string& option() const { return option_; }
  const std::string& hint() const { return hint_; }

 private:
  std::string option_, hint_;
};

}  // namespace avoidbench
