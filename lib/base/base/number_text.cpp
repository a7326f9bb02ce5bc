#include "base/number_text.hpp"

#include <array>
#include <charconv>
#include <system_error>

#include "base/check.hpp"

namespace avoidbench {
namespace {

/// The text that `write(first, last)` makes in a buffer; the largest double has 309 digits before
/// the point.
template <class Write>
std::string written(Write&& write) {
  std::array<char, 400> buffer{};
  const std::to_chars_result result = write(buffer.data(), buffer.data() + buffer.size());
  AB_CHECK(result.ec == std::errc{});
  return {buffer.data(), result.ptr};
}

}  // namespace

std::string shortest(double value) {
  if (value != value) return "nan";  // of either sign
  return written([&](char* first, char* last) { return std::to_chars(first, last, value); });
}

std::string fixed_digits(double value, int decimals) {
  if (value != value) return "nan";
  AB_CHECK(decimals >= 0 && decimals <= 60, decimals);
  return written([&](char* first, char* last) {
    return std::to_chars(first, last, value, std::chars_format::fixed, decimals);
  });
}

std::string significant_digits(double value, int digits) {
  if (value != value) return "nan";
  AB_CHECK(digits >= 1 && digits <= 60, digits);
  return written([&](char* first, char* last) {
    return std::to_chars(first, last, value, std::chars_format::general, digits);
  });
}

}  // namespace avoidbench
