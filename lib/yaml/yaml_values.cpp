#include "yaml/yaml_values.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

namespace avoidbench {
namespace {

using Problems = std::vector<InputProblem>;

void add_problem(const YamlNode& node, const std::string& path, const std::string& message,
                 Problems& problems) {
  problems.push_back(problem_at(node, path.empty() ? message : path + ": " + message));
}

void add_expected(const YamlNode& node, const std::string& path, const std::string& what,
                  Problems& problems) {
  add_problem(node, path, "expected " + what + ", found " + found_text(node), problems);
}

bool is_plain(const YamlNode& node) {
  return node.kind == YamlNode::Kind::scalar && !node.is_quoted;
}

/// The scalar as a T where all of it is one. `too_large` tells an overflow from other text.
template <class T>
std::optional<T> parsed(const YamlNode& node, bool& too_large) {
  too_large = false;
  if (!is_plain(node)) return std::nullopt;
  std::string_view text = node.scalar;
  // from_chars takes no plus sign; "+-1" is none of its either.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // Text behind the number: no number at all, even if what is before it would overflow.
  if (end != text.data() + text.size()) return std::nullopt;
  too_large = error == std::errc::result_out_of_range;
  if (error != std::errc{}) return std::nullopt;
  return value;
}

std::string range_text(Range range) {
  if (std::isinf(range.lowest)) return " is above " + number_text(range.highest);
  if (std::isinf(range.highest)) return " is below " + number_text(range.lowest);
  return " is outside [" + number_text(range.lowest) + ", " + number_text(range.highest) + "]";
}

bool check_range(const YamlNode& node, const std::string& path, double value, Range range,
                 Problems& problems) {
  if (value >= range.lowest && value <= range.highest) return true;
  add_problem(node, path, node.scalar + range_text(range), problems);
  return false;
}

/// Whole numbers may be written as 12, 12.0 or 1.2e1. Read as a whole number first, since a double
/// would lose the last digits of large seeds.
template <class T>
std::optional<T> whole_of(const YamlNode& node, const std::string& path, Range range,
                          Problems& problems) {
  const auto problem = [&](const std::string& message) {
    add_problem(node, path, message, problems);
    return std::nullopt;
  };
  bool too_large = false;
  std::optional<T> whole = parsed<T>(node, too_large);
  if (!whole) {
    constexpr double kLargestExact = 9007199254740992.0;  // 2^53
    const std::optional<double> number = number_of(node);
    if (!number && too_large) return problem(node.scalar + " is too large");
    if (!number || std::floor(*number) != *number) {
      return problem("expected a whole number, found " + found_text(node));
    }
    if (*number < 0.0 && !std::is_signed_v<T>) return problem(node.scalar + " is below 0");
    // Beyond 2^53 not every whole number is a double: which one was meant is unknown.
    if (std::abs(*number) > kLargestExact) return problem(node.scalar + " is too large");
    whole = static_cast<T>(*number);
  }
  const bool fits = check_range(node, path, static_cast<double>(*whole), range, problems);
  return fits ? whole : std::nullopt;
}

/// A number that was computed for a range, at the range's place.
YamlNode number_node(const YamlNode& place, double value) {
  std::array<char, 64> text{};
  // So that 3 * 0.1 is 0.3 and not 0.30000000000000004.
  constexpr int kDigits = 12;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value,
                                    std::chars_format::general, kDigits);
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.source = place.source;
  node.line = place.line;
  node.column = place.column;
  node.scalar.assign(text.data(), result.ptr);
  return node;
}

std::optional<double> range_number(const YamlNode& node, const std::string& path,
                                   std::string_view key, Problems& problems) {
  const YamlNode* found = node.find(key);
  if (found == nullptr) {
    add_problem(node, path, "the range lacks '" + std::string(key) + "'", problems);
    return std::nullopt;
  }
  const std::optional<double> number = number_of(*found);
  if (!number) add_expected(*found, path + "." + std::string(key), "a number", problems);
  return number;
}

std::vector<YamlNode> range_values(const YamlNode& node, const std::string& path,
                                   Problems& problems) {
  constexpr double kLongestRange = 10000;
  const std::vector<std::string> known{"from", "to", "count", "step"};
  const std::size_t before = problems.size();
  for (const YamlNode& key : node.keys) {
    if (std::find(known.begin(), known.end(), key.scalar) == known.end()) {
      add_problem(key, path + "." + key.scalar,
                  "unknown key of a range" + did_you_mean(key.scalar, known) +
                      "; a range is {from, to, count} or {from, to, step}",
                  problems);
    }
  }
  if (problems.size() > before) return {};
  const std::optional<double> from = range_number(node, path, "from", problems);
  const std::optional<double> to = range_number(node, path, "to", problems);
  const bool by_step = node.find("step") != nullptr;
  if (by_step == (node.find("count") != nullptr)) {
    add_problem(node, path, "a range has either 'count' or 'step'", problems);
    return {};
  }
  const std::optional<double> third =
      range_number(node, path, by_step ? "step" : "count", problems);
  if (!from || !to || !third) return {};

  double count = *third;
  if (by_step) {
    const double steps = (*to - *from) / *third;
    if (!(steps >= 0.0)) {
      add_problem(*node.find("step"), path + ".step", "leads away from 'to'", problems);
      return {};
    }
    // 0.3 / 0.1 is 2.9999999999999996: the end is meant to be among the values.
    count = std::floor(steps + 1e-9) + 1.0;
  } else if (std::floor(count) != count || count < 1.0 || (count == 1.0 && *from != *to)) {
    add_problem(*node.find("count"), path + ".count",
                "expected a whole number of at least 2, found " + number_text(count), problems);
    return {};
  }
  if (count > kLongestRange) {
    add_problem(node, path, "the range has more than " + number_text(kLongestRange) + " values",
                problems);
    return {};
  }
  std::vector<YamlNode> values;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    const double i = k;
    // By multiplying: a running sum would add up the rounding of the step.
    const double value = by_step       ? *from + i * *third
                         : count > 1.0 ? *from + i * (*to - *from) / (count - 1.0)
                                       : *from;
    values.push_back(number_node(node, value));
  }
  return values;
}

/// The same text for values that mean the same: 3 and 3.0, also in lists.
/// Used to find values of an axis that are given twice, which would fly each trial of theirs twice.
std::string meaning(const YamlNode& node) {
  const std::optional<double> number = number_of(node);
  if (number) return number_text(*number);
  std::string text = node.scalar;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    text += "\n";
    if (i < node.keys.size()) text += node.keys[i].scalar + ": ";
    text += "(" + meaning(node.items[i]) + ")";
  }
  return text;
}

}  // namespace

std::string number_text(double value) {
  std::array<char, 64> text{};
  // 0.0001 up to 10^15 without exponent.
  const auto plain = std::abs(value) < 1e15 && (value == 0.0 || std::abs(value) >= 1e-4)
                         ? std::chars_format::fixed
                         : std::chars_format::general;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, plain);
  return {text.data(), result.ptr};
}

std::optional<double> number_of(const YamlNode& node) {
  bool too_large = false;
  const std::optional<double> number = parsed<double>(node, too_large);
  // from_chars also reads "inf" and "nan".
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<double> read_number(const YamlNode& node, const std::string& path, Range range,
                                  Problems& problems) {
  bool too_large = false;
  const std::optional<double> number = parsed<double>(node, too_large);
  const bool is_infinite_text =
      // YAML's own words for them, which from_chars does not know.
      is_plain(node) && (node.scalar.find(".inf") != std::string::npos || node.scalar == ".nan");
  if (too_large) {
    add_problem(node, path, node.scalar + " is too large or too small", problems);
  } else if ((number && !std::isfinite(*number)) || is_infinite_text) {
    add_expected(node, path, "a finite number", problems);
  } else if (!number) {
    add_expected(node, path, "a number", problems);
  } else if (check_range(node, path, *number, range, problems)) {
    return number;
  }
  return std::nullopt;
}

std::optional<std::int64_t> read_whole(const YamlNode& node, const std::string& path, Range range,
                                       Problems& problems) {
  return whole_of<std::int64_t>(node, path, range, problems);
}

std::optional<std::uint64_t> read_unsigned(const YamlNode& node, const std::string& path,
                                           Range range, Problems& problems) {
  return whole_of<std::uint64_t>(node, path, range, problems);
}

std::optional<bool> read_truth(const YamlNode& node, const std::string& path, Problems& problems) {
  const bool is_true = is_plain(node) && node.scalar == "true";
  if (is_true || (is_plain(node) && node.scalar == "false")) return is_true;
  add_expected(node, path, "true or false", problems);
  return std::nullopt;
}

std::optional<std::string> read_text(const YamlNode& node, const std::string& path,
                                     Problems& problems) {
  if (node.kind == YamlNode::Kind::scalar) return node.scalar;
  add_expected(node, path, "text", problems);
  return std::nullopt;
}

std::optional<std::string> read_choice(const YamlNode& node, const std::string& path,
                                       const std::vector<std::string>& words, Problems& problems) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  if (node.kind != YamlNode::Kind::scalar) {
    add_expected(node, path, (words.size() > 1 ? "one of " : "") + all, problems);
    return std::nullopt;
  }
  if (std::find(words.begin(), words.end(), node.scalar) != words.end()) return node.scalar;
  add_problem(node, path,
              found_text(node) + (words.size() > 1 ? " is none of " : " is not ") + all +
                  did_you_mean(node.scalar, words),
              problems);
  return std::nullopt;
}

bool check_list(const YamlNode& node, const std::string& path, std::optional<std::size_t> count,
                Problems& problems) {
  const std::string what = count ? "a list of " + std::to_string(*count) + " values" : "a list";
  if (node.kind != YamlNode::Kind::list) {
    add_expected(node, path, what, problems);
    return false;
  }
  if (!count || node.items.size() == *count) return true;
  add_problem(node, path, "expected " + what + ", found " + std::to_string(node.items.size()),
              problems);
  return false;
}

std::vector<YamlNode> axis_values(const YamlNode& node, const std::string& path,
                                  Problems& problems) {
  if (node.kind == YamlNode::Kind::mapping) return range_values(node, path, problems);
  if (node.kind != YamlNode::Kind::list) return {node};
  if (node.items.empty()) {
    add_problem(node, path, "expected at least one value, found an empty list", problems);
    return {};
  }
  std::set<std::string> seen;
  for (const YamlNode& item : node.items) {
    if (item.kind == YamlNode::Kind::null || seen.insert(meaning(item)).second) continue;
    const std::string what = item.kind == YamlNode::Kind::scalar ? item.scalar : found_text(item);
    add_problem(item, path, what + " is given twice", problems);
  }
  return node.items;
}

}  // namespace avoidbench
