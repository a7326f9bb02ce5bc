#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace avoidbench {

/// What a row has in a column that is not known beforehand: nothing, text, whole number, number.
using FieldValue = std::variant<std::monostate, std::string, std::int64_t, double>;

}  // namespace avoidbench
