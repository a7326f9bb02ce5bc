#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// The shortest decimal text that reads back as the same double.
std::string number_text(double value);

/// The scalar's text as a number, independent of the locale; nothing for what is no finite number
/// or stands in quotes.
std::optional<double> number_of(const YamlNode& node);

/// A scalar of the type, or nothing after adding a problem.
std::optional<double> read_number(const GivenValue& given, Range range);
std::optional<bool> read_truth(const GivenValue& given);
std::optional<std::string> read_text(const GivenValue& given);
/// A std::int64_t or std::uint64_t.
template <class Whole>
std::optional<Whole> read_whole(const GivenValue& given, Range range);
/// One of `words`.
std::optional<std::string> read_choice(const GivenValue& given,
                                       const std::vector<std::string>& words);

/// Whether the node is a list (of `count` elements where given); adds a problem where not.
bool check_list(const GivenValue& given, std::optional<std::size_t> count = {});

/// The values of an axis: those of a list, or of `{from, to, count}` (evenly spaced, both ends
/// included) or `{from, to, step}`. Computed values are rounded to 12 digits, so that 0.1 × 3 is
/// 0.3. Empty after a problem.
std::vector<YamlNode> axis_values(const GivenValue& given);

}  // namespace avoidbench
