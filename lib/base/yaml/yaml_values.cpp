#include "yaml/yaml_values.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "base/number_text.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

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

bool check_range(const GivenValue& given, double value, Range range) {
  const bool fits = value >= range.lowest && value <= range.highest;
  if (!fits) given.add_problem(given.node.scalar + range_text(range));
  return fits;
}

/// A number that was computed for a range, at the range's place.
YamlNode number_node(const YamlNode& place, double value) {
  // So that 3 * 0.1 is 0.3 and not 0.30000000000000004.
  constexpr int kDigits = 12;
  return node_at(place, YamlNode::Kind::scalar, significant_digits(value, kDigits));
}

/// The value of a range's key, which has to be there.
std::optional<double> range_number(const GivenValue& range, const std::string& key) {
  const YamlNode* found = range.node.find(key);
  if (found == nullptr) return range.add_problem("the range lacks '" + key + "'");
  const std::optional<double> number = number_of(*found);
  if (!number) range.at(*found, key).add_expected("a number");
  return number;
}

std::optional<std::vector<YamlNode>> range_values(const GivenValue& range) {
  constexpr double kLongestRange = 10000;
  const std::vector<std::string> known{"from", "to", "count", "step"};
  for (const YamlNode& key : range.node.keys) {
    if (contains(known, key.scalar)) continue;
    return range.at(key, key.scalar)
        .add_problem("unknown key of a range" + did_you_mean(key.scalar, known) +
                     "; a range is {from, to, count} or {from, to, step}");
  }
  const std::optional<double> from = range_number(range, "from");
  const std::optional<double> to = range_number(range, "to");
  const bool by_step = range.node.find("step") != nullptr;
  if (by_step == (range.node.find("count") != nullptr)) {
    return range.add_problem("a range has either 'count' or 'step'");
  }
  const std::string third_key = by_step ? "step" : "count";
  const std::optional<double> third = range_number(range, third_key);
  if (!from || !to || !third) return std::nullopt;

  const GivenValue given_third = range.at(*range.node.find(third_key), third_key);
  double count = *third;
  if (by_step) {
    if (*third == 0.0) return given_third.add_problem("must not be 0");
    const double steps = (*to - *from) / *third;
    if (!(steps >= 0.0)) return given_third.add_problem("leads away from 'to'");
    // 0.3 / 0.1 is 2.9999999999999996: the end is meant to be among the values.
    count = std::floor(steps + 1e-9) + 1.0;
  } else if (std::floor(count) != count || count < 1.0 || (count == 1.0 && *from != *to)) {
    return given_third.add_problem("expected a whole number of at least 2, found " +
                                   number_text(count));
  }
  if (count > kLongestRange) {
    return range.add_problem("the range has more than " + number_text(kLongestRange) + " values");
  }
  std::vector<YamlNode> values;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    const double i = k;
    // By multiplying: a running sum would add up the rounding of the step.
    const double value = by_step       ? *from + i * *third
                         : count > 1.0 ? *from + i * (*to - *from) / (count - 1.0)
                                       : *from;
    values.push_back(number_node(range.node, value));
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

std::optional<double> read_number(const GivenValue& given, Range range) {
  const YamlNode& node = given.node;
  bool too_large = false;
  const std::optional<double> number = parsed<double>(node, too_large);
  if (too_large) return given.add_problem(node.scalar + " is too large or too small");
  const bool is_infinite_text =
      // YAML's own words for them, which from_chars does not know.
      is_plain(node) && (node.scalar.find(".inf") != std::string::npos || node.scalar == ".nan");
  if (is_infinite_text || (number && !std::isfinite(*number))) {
    return given.add_expected("a finite number");
  }
  if (!number) return given.add_expected("a number");
  return check_range(given, *number, range) ? number : std::nullopt;
}

/// Whole numbers may be written as 12, 12.0 or 1.2e1. Read as a whole number first, since a double
/// would lose the last digits of large seeds.
template <class Whole>
std::optional<Whole> read_whole(const GivenValue& given, Range range) {
  bool too_large = false;
  std::optional<Whole> whole = parsed<Whole>(given.node, too_large);
  if (!whole) {
    constexpr double kLargestExact = 9007199254740992.0;  // 2^53
    const std::optional<double> number = number_of(given.node);
    if (!number && too_large) return given.add_problem(given.node.scalar + " is too large");
    if (!number || std::floor(*number) != *number) return given.add_expected("a whole number");
    if (*number < 0.0 && !std::is_signed_v<Whole>) {
      return given.add_problem(given.node.scalar + " is below 0");
    }
    // Beyond 2^53 not every whole number is a double: which one was meant is unknown.
    if (std::abs(*number) > kLargestExact) {
      return given.add_problem(given.node.scalar + " is too large");
    }
    whole = static_cast<Whole>(*number);
  }
  return check_range(given, static_cast<double>(*whole), range) ? whole : std::nullopt;
}

template std::optional<std::int64_t> read_whole(const GivenValue& given, Range range);
template std::optional<std::uint64_t> read_whole(const GivenValue& given, Range range);

std::optional<bool> read_truth(const GivenValue& given) {
  const bool is_true = is_plain(given.node) && given.node.scalar == "true";
  if (is_true || (is_plain(given.node) && given.node.scalar == "false")) return is_true;
  return given.add_expected("true or false");
}

std::optional<std::string> read_text(const GivenValue& given) {
  if (given.node.kind == YamlNode::Kind::scalar) return given.node.scalar;
  return given.add_expected("text");
}

std::optional<std::string> read_choice(const GivenValue& given,
                                       const std::vector<std::string>& words) {
  const YamlNode& node = given.node;
  const bool is_one = words.size() == 1;
  if (node.kind != YamlNode::Kind::scalar) {
    return given.add_expected((is_one ? "" : "one of ") + joined(words));
  }
  if (std::find(words.begin(), words.end(), node.scalar) != words.end()) return node.scalar;
  return given.add_problem(found_text(node) + (is_one ? " is not " : " is not one of ") +
                           joined(words) + did_you_mean(node.scalar, words));
}

bool check_list(const GivenValue& given, std::optional<std::size_t> count) {
  const std::vector<YamlNode>& items = given.node.items;
  const std::string what = count ? "a list of " + counted(*count, "value") : "a list";
  const bool is_list = given.node.kind == YamlNode::Kind::list;
  if (is_list && (!count || items.size() == *count)) return true;
  if (is_list) given.add_problem("expected " + what + ", found " + std::to_string(items.size()));
  if (!is_list) given.add_expected(what);
  return false;
}

std::vector<YamlNode> axis_values(const GivenValue& given) {
  const YamlNode& node = given.node;
  if (node.kind == YamlNode::Kind::mapping) {
    return range_values(given).value_or(std::vector<YamlNode>{});
  }
  if (node.kind != YamlNode::Kind::list) return {node};
  if (node.items.empty()) {
    given.add_problem("expected at least one value, found an empty list");
    return {};
  }
  std::set<std::string> seen;
  for (const YamlNode& item : node.items) {
    if (item.kind == YamlNode::Kind::null || seen.insert(meaning(item)).second) continue;
    const std::string what = item.kind == YamlNode::Kind::scalar ? item.scalar : found_text(item);
    GivenValue{item, given.path, given.reading}.add_problem(what + " is given twice");
  }
  return node.items;
}

}  // namespace avoidbench
