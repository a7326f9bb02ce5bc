#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "yaml/yaml_tree.hpp"

namespace avoidbench {

/// The shortest decimal text that reads back as the same double.
std::string number_text(double value);

/// The scalar's text as a number, independent of the locale; nothing for what is no finite number
/// or stands in quotes.
std::optional<double> number_of(const YamlNode& node);

/// A scalar of the type, or nothing after adding a problem.
std::optional<double> read_number(const YamlNode& node, const std::string& path, Range range,
                                  std::vector<InputProblem>& problems);
std::optional<std::int64_t> read_whole(const YamlNode& node, const std::string& path, Range range,
                                       std::vector<InputProblem>& problems);
std::optional<std::uint64_t> read_unsigned(const YamlNode& node, const std::string& path,
                                           Range range, std::vector<InputProblem>& problems);
std::optional<bool> read_truth(const YamlNode& node, const std::string& path,
                               std::vector<InputProblem>& problems);
std::optional<std::string> read_text(const YamlNode& node, const std::string& path,
                                     std::vector<InputProblem>& problems);

/// One of `words`, or nothing after adding a problem.
std::optional<std::string> read_choice(const YamlNode& node, const std::string& path,
                                       const std::vector<std::string>& words,
                                       std::vector<InputProblem>& problems);

/// Whether the node is a list (of `count` elements where given); adds a problem where not.
bool check_list(const YamlNode& node, const std::string& path, std::optional<std::size_t> count,
                std::vector<InputProblem>& problems);

/// The values of an axis: those of a list, or of `{from, to, count}` (evenly spaced, both ends
/// included) or `{from, to, step}`. Computed values are rounded to 12 digits, so that 0.1 × 3 is
/// 0.3. Empty after a problem.
std::vector<YamlNode> axis_values(const YamlNode& node, const std::string& path,
                                  std::vector<InputProblem>& problems);

}  // namespace avoidbench
