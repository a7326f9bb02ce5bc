#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace avoidbench {

// Numbers as text, the same whatever locale a planner or a library has set, at any time, in any
// thread: printf, streams and std::to_string write a comma where the locale has one.

/// The number with the fewest digits that read back to the same bits; `nan`, `inf`, `-inf`.
std::string shortest(double value);

/// The number that the whole text is, as from_chars() reads it in this `base` (of whole numbers) or
/// format; nothing where it is none.
template <class Number, class... Base>
std::optional<Number> number_from(std::string_view text, Base... base) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number, base...);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

/// As printf's %.*f: so many digits after the point.
std::string fixed_digits(double value, int decimals);

/// As printf's %.*g: so many significant digits, without zeros at the end.
std::string significant_digits(double value, int digits);

}  // namespace avoidbench
