#include <cmath>
#include <optional>

#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"
#include "compare/compare.hpp"
#include "yaml/yaml_tree.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

/// A finite number from 0 on, where the text is nothing else.
std::optional<double> share_from(std::string_view text) {
  const std::optional<double> value = number_from<double>(text);
  return value && std::isfinite(*value) && *value >= 0.0 ? value : std::nullopt;
}

/// The share that `12%` says.
std::optional<double> percent_from(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  const std::optional<double> value = share_from(text);
  return value ? std::optional(*value / 100.0) : std::nullopt;
}

/// What a file says of a metric; nothing where it says no such thing.
std::optional<Tolerance> tolerance_from(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::scalar) return std::nullopt;
  if (node.scalar == "ignore") return Tolerance{Tolerance::Kind::ignored, 0.0};
  if (const auto share = percent_from(node.scalar)) {
    return Tolerance{Tolerance::Kind::relative, *share};
  }
  const std::optional<double> number = number_of(node);
  if (!number || *number < 0.0) return std::nullopt;
  return Tolerance{Tolerance::Kind::absolute, *number};
}

}  // namespace

Tolerance min_effect_from(std::string_view text) {
  // 0.05 is a share here, not a number in the metric's unit as in a file: it is for metrics of all
  // units.
  std::optional<double> share = percent_from(text);
  if (!share) share = share_from(text);
  if (!share) {
    throw OptionError(
        std::string(text) + ": expected a share of the base's mean such as 5% or 0.05",
        "min-effect");
  }
  return {Tolerance::Kind::relative, *share};
}

void read_tolerances(const std::filesystem::path& file, const std::vector<std::string>& metrics,
                     CompareSettings& settings) {
  const YamlNode root = read_yaml(file);
  std::vector<InputProblem> problems;
  if (root.kind != YamlNode::Kind::mapping) {
    throw InputError(
        problem_at(root, "expected a mapping (metric: tolerance), found " + found_text(root)));
  }
  std::vector<std::string> known = metrics;
  // These are no metrics of a table, `default` none at all.
  known.insert(known.end(), {"default", "success_rate", "v90_mps"});
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    const std::string& name = root.keys[i].scalar;
    if (!contains(known, name)) {
      problems.push_back(
          problem_at(root.keys[i], name + ": no such metric" + did_you_mean(name, known)));
    }
    const std::optional<Tolerance> tolerance = tolerance_from(root.items[i]);
    if (!tolerance) {
      problems.push_back(
          problem_at(root.items[i], name +
                                        ": expected a share of the base's mean (5%), a number "
                                        "in the metric's unit, or ignore; found " +
                                        found_text(root.items[i])));
    } else if (name == "default") {
      settings.tolerance = *tolerance;
    } else {
      settings.tolerances[name] = *tolerance;
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace avoidbench
