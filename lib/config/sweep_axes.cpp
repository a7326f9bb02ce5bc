#include "config/sweep_axes.hpp"

#include <algorithm>

#include "config/sweep_keys.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;

/// "map.poisson_radius_m" as a JSON pointer.
Json::json_pointer pointer(const std::string& path) {
  std::string text = "/" + path;
  std::replace(text.begin(), text.end(), '.', '/');
  return Json::json_pointer(text);
}

/// {a: {b: value}} for "a.b"; every level stands at the place of `key`.
YamlNode nested(const std::string& path, const YamlNode& key, const YamlNode& value) {
  const std::size_t dot = path.find('.');
  YamlNode name = key;
  name.scalar = path.substr(0, dot);
  YamlNode mapping = key;
  mapping.kind = YamlNode::Kind::mapping;
  mapping.keys.push_back(std::move(name));
  const bool is_last = dot == std::string::npos;
  mapping.items.push_back(is_last ? value : nested(path.substr(dot + 1), key, value));
  return mapping;
}

/// Why `path` can't be an axis, or "".
std::string path_problem(const std::string& path, const TrialSpec& base) {
  const std::string first = path.substr(0, path.find('.'));
  if (first == "planner" || first == "planners") {
    return "write a planner's parameters as lists in its entry of 'planners'";
  }
  if (first == "mission_index" || first == "trials")
    return "'trials' says how many missions there are";
  if (first == "latency_digest") return "the program fills it";
  if (path.find('[') != std::string::npos)
    return "elements of lists can't be axes; give whole lists";
  if (path.empty() || path.front() == '.' || path.back() == '.' ||
      path.find("..") != std::string::npos || path.find_first_of("/~") != std::string::npos) {
    return "no dotted path such as wind.mean_world_mps";
  }
  const FieldTree trial = field_tree("", base, "");
  for (const KindField& found : fields_at(trial, path)) {
    if (found.field->kind != FieldKind::variant) continue;
    return "a " + found.field->name + " can't be an axis; write one sweep for each";
  }
  const Json json = spec_to_json(base);
  if (json.contains(pointer(path)) && json.at(pointer(path)).is_object()) {
    return "is a group of fields, not one";
  }
  return "";
}

void read_axis(const YamlNode& key, const YamlNode& node, SweepSpec& sweep, Reading& reading) {
  const std::string path = trial_path(key.scalar);
  std::string problem = path_problem(path, sweep.base);
  for (const Axis& other : sweep.axes) {
    if (other.path == path) problem = "has several values above already";
  }
  if (!problem.empty()) {
    reading.problems.push_back(problem_at(key, "axes." + key.scalar + ": " + problem));
    return;
  }
  constexpr std::size_t kMostProblems = 5;
  Axis axis{path, {}};
  const std::size_t before = reading.problems.size();
  for (const YamlNode& value : axis_values(node, "axes." + key.scalar, reading.problems)) {
    TrialSpec trial = sweep.base;
    read_spec(nested(path, key, value), "", trial, reading);
    if (reading.problems.size() >= before + kMostProblems) break;
    if (reading.problems.size() == before) {
      axis.values.push_back(spec_to_json(trial).at(pointer(path)));
    }
  }
  if (reading.problems.size() == before) sweep.axes.push_back(std::move(axis));
}

TrialSpec with_values(const SweepSpec& sweep, const std::vector<std::size_t>& choice) {
  Json json = spec_to_json(sweep.base);
  for (std::size_t i = 0; i < choice.size(); ++i) {
    json.at(pointer(sweep.axes[i].path)) = sweep.axes[i].values[choice[i]];
  }
  return spec_from_json<TrialSpec>(json);
}

template <std::size_t... index>
std::vector<std::string> kinds_of(std::index_sequence<index...>) {
  return {std::string(std::variant_alternative_t<index, MapSpec>::kind)...};
}

}  // namespace

std::vector<std::string> generator_names() {
  return kinds_of(std::make_index_sequence<std::variant_size_v<MapSpec>>());
}

void read_maps(const YamlNode& node, TrialSpec& trial, Reading& reading) {
  SpecReader reader(node, "maps", reading);
  const YamlNode* seeds = reader.take("seeds");
  visit(reader, trial.map);
  reader.finish();
  if (seeds == nullptr) return;
  if (seeds->kind != YamlNode::Kind::scalar) {
    YamlNode list = node;  // as a field named `seeds` of a spec would be read
    list.keys = {node.keys[static_cast<std::size_t>(seeds - node.items.data())]};
    list.items = {*seeds};
    SpecReader(list, "maps", reading).field("seeds", trial.map_seed, "");
    return;
  }
  std::int64_t count = 1;
  const std::size_t before = reading.problems.size();
  read_scalar(*seeds, "maps.seeds", count, Range{1, 10000}, reading.problems);
  if (reading.problems.size() > before) return;
  trial.map_seed = 1;
  ReadAxis axis{"maps.seeds", {}, *seeds};
  for (std::int64_t seed = 1; seed <= count; ++seed) axis.values.emplace_back(seed);
  if (count > 1) reading.axes.push_back(std::move(axis));
}

std::vector<Axis> axes_of_blocks(const Reading& reading) {
  std::vector<Axis> axes;
  for (const ReadAxis& axis : reading.axes) axes.push_back({trial_path(axis.path), axis.values});
  return axes;
}

void read_axes(const YamlNode& node, SweepSpec& sweep, Reading& reading) {
  if (node.kind == YamlNode::Kind::null) return;
  if (node.kind != YamlNode::Kind::mapping) {
    reading.problems.push_back(
        problem_at(node, "axes: expected a mapping {path: [values]}, found " + found_text(node)));
    return;
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    read_axis(node.keys[i], node.items[i], sweep, reading);
  }
}

const YamlNode* axis_key(const YamlNode& root, const std::string& path) {
  const YamlNode* axes = root.find("axes");
  if (axes == nullptr) return nullptr;
  for (const YamlNode& key : axes->keys) {
    if (trial_path(key.scalar) == path) return &key;
  }
  return nullptr;
}

void for_each_combination(const SweepSpec& sweep,
                          const std::function<void(const TrialSpec&)>& check) {
  constexpr std::size_t kMostCombinations = 4096;
  std::size_t total = 1;
  for (const Axis& axis : sweep.axes) {
    total *= axis.values.size();
    if (total > kMostCombinations) break;
  }
  std::vector<std::size_t> choice(sweep.axes.size(), 0);
  if (total > kMostCombinations) {
    check(with_values(sweep, choice));
    for (std::size_t i = 0; i < choice.size(); ++i) {
      for (choice[i] = 1; choice[i] < sweep.axes[i].values.size(); ++choice[i]) {
        check(with_values(sweep, choice));
      }
      choice[i] = 0;
    }
    return;
  }
  for (std::size_t number = 0; number < total; ++number) {
    std::size_t rest = number;
    for (std::size_t i = choice.size(); i-- > 0;) {
      choice[i] = rest % sweep.axes[i].values.size();
      rest /= sweep.axes[i].values.size();
    }
    check(with_values(sweep, choice));
  }
}

}  // namespace avoidbench
