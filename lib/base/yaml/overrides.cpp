#include "yaml/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace avoidbench {
namespace {

/// `planners[0]` of a path: a key, then positions in the lists below it.
struct Step {
  std::string key;
  std::vector<std::size_t> indices;
};

/// `a.b[2].c` as its steps, or nothing where it is malformed.
std::optional<std::vector<Step>> parse_path(std::string_view path) {
  std::vector<Step> steps;
  while (true) {
    const std::size_t dot = path.find('.');
    std::string_view part = path.substr(0, dot);
    Step step;
    step.key = part.substr(0, part.find('['));
    if (step.key.empty()) return std::nullopt;
    part.remove_prefix(step.key.size());
    while (!part.empty()) {
      const std::size_t close = part.find(']');
      if (part[0] != '[' || close == std::string_view::npos) return std::nullopt;
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(part.data() + 1, part.data() + close, index);
      if (error != std::errc{} || end != part.data() + close) return std::nullopt;
      step.indices.push_back(index);
      part.remove_prefix(close + 1);
    }
    steps.push_back(std::move(step));
    if (dot == std::string_view::npos) return steps;
    path.remove_prefix(dot + 1);
  }
}

/// Makes a mapping of what is there: of nothing an empty one, of a name `{preset: name}`.
bool become_mapping(YamlNode& node, const YamlNode& place) {
  if (node.kind == YamlNode::Kind::scalar) node = mapping_at(node, "preset", node);
  if (node.kind == YamlNode::Kind::null) node = node_at(place, YamlNode::Kind::mapping);
  return node.kind == YamlNode::Kind::mapping;
}

/// What the command line gives has no line to point at.
void forget_place(YamlNode& node) {
  node.line = node.column = 0;
  for (YamlNode& key : node.keys) forget_place(key);
  for (YamlNode& item : node.items) forget_place(item);
}

/// Sets `path` in the tree to `value`, adding what is missing on the way. Returns what is wrong, ""
/// where nothing is. The tree may be half changed then; nobody reads it after a problem.
std::string apply_override(YamlNode& root, const std::string& path, const YamlNode& value) {
  const auto steps = parse_path(path);
  if (!steps) return "'" + path + "' is not a dotted path such as maps.poisson_radius_m";
  YamlNode* node = &root;
  for (const Step& step : *steps) {
    if (!become_mapping(*node, value)) return path + ": a list is above '" + step.key + "'";
    const std::size_t at = node->index_of(step.key);
    if (at == node->keys.size()) {
      node->keys.push_back(node_at(value, YamlNode::Kind::scalar, step.key));
      // Nothing yet: become_mapping() makes a mapping of it if the path goes on.
      node->items.push_back(node_at(value, YamlNode::Kind::null));
    }
    YamlNode* found = &node->items[at];
    for (const std::size_t index : step.indices) {
      if (found->kind != YamlNode::Kind::list || index >= found->items.size()) {
        return path + ": " + step.key + " has no element " + std::to_string(index);
      }
      found = &found->items[index];
    }
    node = found;
  }
  *node = value;
  return "";
}

}  // namespace

void apply_overrides(YamlNode& root, const std::vector<std::string>& overrides) {
  std::vector<InputProblem> problems;
  for (const std::string& option : overrides) {
    const std::string source = "--set " + option;
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == option.size()) {
      problems.push_back({source, 0, 0, "expected path=value"});
      continue;
    }
    try {
      YamlNode value = parse_yaml(option.substr(equals + 1), source);
      forget_place(value);
      const std::string problem = apply_override(root, option.substr(0, equals), value);
      if (!problem.empty()) problems.push_back({source, 0, 0, problem});
    } catch (const InputError& error) {
      for (InputProblem problem : error.problems()) {
        problem.line = problem.column = 0;
        problems.push_back(std::move(problem));
      }
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace avoidbench
