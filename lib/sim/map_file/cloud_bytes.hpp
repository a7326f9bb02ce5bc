#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "map_file/map_file.hpp"

/// Words and numbers out of bytes, for the readers of point clouds.
namespace avoidbench {

enum class NumberType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

inline std::size_t size_of(NumberType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

template <class T>
T load(const char* bytes, bool is_big_endian) {
  char raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    raw[i] = bytes[is_big_endian ? sizeof(T) - 1 - i : i];
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

/// The number at `bytes`, of which size_of(type) must be there.
inline double load_number(const char* bytes, NumberType type, bool is_big_endian) {
  static_assert(std::endian::native == std::endian::little, "x86-64 only");
  const auto as = [&]<class T>(T) { return static_cast<double>(load<T>(bytes, is_big_endian)); };
  switch (type) {
    case NumberType::i8:
      return as(std::int8_t{});
    case NumberType::u8:
      return as(std::uint8_t{});
    case NumberType::i16:
      return as(std::int16_t{});
    case NumberType::u16:
      return as(std::uint16_t{});
    case NumberType::i32:
      return as(std::int32_t{});
    case NumberType::u32:
      return as(std::uint32_t{});
    case NumberType::i64:
      return as(std::int64_t{});
    case NumberType::u64:
      return as(std::uint64_t{});
    case NumberType::f32:
      return as(float{});
    case NumberType::f64:
      return as(double{});
  }
  return 0.0;
}

/// Takes lines off the front of a file's bytes and counts them.
struct LineCursor {
  std::string_view rest;
  int line = 0;  ///< of the one taken last, from 1

  /// The next line without its end, \n or \r\n; nothing at the end of the bytes.
  std::optional<std::string_view> next() {
    if (rest.empty()) return std::nullopt;
    const std::size_t end = rest.find('\n');
    std::string_view taken = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (!taken.empty() && taken.back() == '\r') taken.remove_suffix(1);
    ++line;
    return taken;
  }
};

/// Takes the next word off the front; "" where there is none.
inline std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    text = {};
    return {};
  }
  text.remove_prefix(first);
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

inline std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (auto word = take_word(line); !word.empty(); word = take_word(line)) words.push_back(word);
  return words;
}

/// 0 or infinity, with its sign, for a decimal number that is too near 0 or too far from it for a
/// double: from_chars() does not say which.
inline double beyond_double(std::string_view word) {
  const double sign = word.starts_with('-') ? -1.0 : 1.0;
  if (sign < 0.0) word.remove_prefix(1);
  const std::string_view digits = word.substr(0, word.find_first_of("eE"));
  std::string_view power = word.substr(std::min(word.size(), digits.size() + 1));
  if (power.starts_with('+')) power.remove_prefix(1);
  std::int64_t exponent = 0;
  const auto read = std::from_chars(power.data(), power.data() + power.size(), exponent);
  // The first digit that is not 0, in places behind the point.
  const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
  const auto first =
      static_cast<std::int64_t>(std::min(digits.find_first_not_of("0."), digits.size()));
  const bool is_tiny =
      read.ec == std::errc::result_out_of_range ? power.starts_with('-') : exponent < first - point;
  return std::copysign(is_tiny ? 0.0 : std::numeric_limits<double>::infinity(), sign);
}

/// The whole word as a number; "nan" and "inf" are numbers here.
template <class T>
std::optional<T> number_in(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(beyond_double(word));
  }
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// A word for messages: printable, not long.
inline std::string in_quotes(std::string_view word) {
  std::string text = "'";
  for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > 40 ? "…'" : "'");
}

inline void add_if_finite(const Eigen::Vector3d& point, FilePoints& points) {
  if (std::isfinite(point.x()) && std::isfinite(point.y()) && std::isfinite(point.z())) {
    points.push_back(point);
  }
}

}  // namespace avoidbench
