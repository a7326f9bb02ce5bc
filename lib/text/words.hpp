#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace avoidbench {

/// "a, b, c".
template <class Words>
std::string joined(const Words& words, std::string_view separator = ", ") {
  std::string all;
  bool is_first = true;
  for (const std::string_view word : words) {
    if (!is_first) all += separator;
    is_first = false;
    all += word;
  }
  return all;
}

/// "1 trial", "3 trials".
inline std::string counted(std::int64_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}
inline std::string counted(std::size_t count, std::string_view noun) {
  return counted(static_cast<std::int64_t>(count), noun);
}

}  // namespace avoidbench
