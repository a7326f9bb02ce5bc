#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "base/number_text.hpp"

namespace avoidbench {

/// A value of any column: nothing (NULL), a whole number, a seed (a whole number without sign), a
/// number, or a text.
using TableValue = std::variant<std::monostate, std::int64_t, std::uint64_t, double, std::string>;

/// The number, whole or not; none for nothing, seeds and texts.
inline std::optional<double> number_in(const TableValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(&value);
  return real == nullptr ? std::nullopt : std::optional(*real);
}

/// With the fewest digits that read back to the same bits; "" for nothing and NaN.
inline std::string text_of(const TableValue& value) {
  if (const auto* words = std::get_if<std::string>(&value)) return *words;
  // Not by way of a double, which would lose digits of large seeds.
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* seed = std::get_if<std::uint64_t>(&value)) return std::to_string(*seed);
  const auto* number = std::get_if<double>(&value);
  return number == nullptr || std::isnan(*number) ? "" : shortest(*number);
}

}  // namespace avoidbench
