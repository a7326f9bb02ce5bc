#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
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

/// The text with each `signs[i].first` as `signs[i].second`; of two that begin at one place, the
/// first in the list.
template <class Signs>
std::string replaced(std::string_view text, const Signs& signs) {
  std::string all;
  while (!text.empty()) {
    // Every sign is tried at every letter: texts and lists are short.
    const auto found = std::find_if(std::begin(signs), std::end(signs),
                                    [&](const auto& sign) { return text.starts_with(sign.first); });
    const bool is_sign = found != std::end(signs);
    // Byte by byte: bytes of other letters of several bytes go through unchanged.
    all += is_sign ? found->second : text.substr(0, 1);
    text.remove_prefix(is_sign ? found->first.size() : 1);
  }
  return all;
}

/// Whether the word is one of these.
template <class Words>
bool contains(const Words& words, std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// The place of the first of these whose `part` is `value`, or nothing.
template <class Range, class Value, class Part = std::identity>
std::optional<std::size_t> place_in(const Range& range, const Value& value, Part part = {}) {
  std::size_t place = 0;
  for (const auto& one : range) {
    if (std::invoke(part, one) == value) return place;
    ++place;
  }
  return std::nullopt;
}

/// "1 trial", "3 trials".
template <std::integral Count>
std::string counted(Count count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace avoidbench
