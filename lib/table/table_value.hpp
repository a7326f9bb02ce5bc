#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace avoidbench {

/// A value of any column: nothing (NULL), a whole number, a seed (a whole number without sign), a
/// number, or a text.
using TableValue = std::variant<std::monostate, std::int64_t, std::uint64_t, double, std::string>;

}  // namespace avoidbench
