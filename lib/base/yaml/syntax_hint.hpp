#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/input_error.hpp"

namespace avoidbench {

/// What is likely wrong with a document that the YAML library refused: a tab that indents, a
/// bracket or quote that is never closed or closes nothing. The library names the place where it
/// gave up, which is often the end of the file. Nothing where none of these is found.
std::optional<InputProblem> syntax_hint(std::string_view text, const std::string& source);

}  // namespace avoidbench
