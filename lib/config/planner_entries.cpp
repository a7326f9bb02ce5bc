#include "config/planner_entries.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "plugin/planner_library.hpp"
#include "text/visible_text.hpp"
#include "yaml/includes.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// A parameter with the values it was given, at least one.
struct GivenParameter {
  std::string name;
  std::vector<ParameterValue> values;
};

struct Entry {
  std::string path;  ///< "planners[0]"
  PlannerDescription planner;
  std::string plugin, label;
  std::vector<GivenParameter> parameters;
};

const ParameterDef* parameter_def(const PlannerDescription& planner, const std::string& name) {
  for (const ParameterDef& def : planner.parameters) {
    if (def.name == name) return &def;
  }
  return nullptr;
}

bool is_number(const ParameterDef& def) { return def.kind == AB_NUMBER || def.kind == AB_INTEGER; }

std::optional<PlannerDescription> load(const YamlNode& node, const std::string& path,
                                       Reading& reading) {
  // Relative to the file that says so; what the command line gives, to where it was typed.
  const fs::path folder = folder_of(node, ".");
  try {
    return describe_planner(find_planner(node.scalar, folder));
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      reading.problems.push_back(problem_at(node, path + ": " + text(problem)));
    }
    return std::nullopt;
  }
}

/// Reads one parameter's value or values, checked by the planner's declaration.
void read_parameter(const YamlNode& key, const YamlNode& node, const std::string& path,
                    Entry& entry, Reading& reading) {
  const ParameterDef* def = parameter_def(entry.planner, key.scalar);
  if (def == nullptr) {
    const auto problems = check_parameters(entry.planner, {{key.scalar, {}}});
    for (const std::string& problem : problems) {
      reading.problems.push_back(problem_at(key, entry.path + ".parameters." + problem));
    }
    return;
  }
  GivenParameter given{key.scalar, {}};
  for (const YamlNode& item : axis_values(node, path, reading.problems)) {
    ParameterValue value;
    const std::size_t before = reading.problems.size();
    if (is_number(*def)) {
      read_scalar(item, path, value.number, Range{}, reading.problems);
    } else {
      read_scalar(item, path, value.text, Range{}, reading.problems);
    }
    if (reading.problems.size() > before) continue;
    for (const std::string& problem : check_parameters(entry.planner, {{key.scalar, value}})) {
      const std::string what = problem.substr(problem.find(": ") + 2);
      reading.problems.push_back(problem_at(item, path + ": " + what));
    }
    given.values.push_back(value);
  }
  if (!given.values.empty()) entry.parameters.push_back(std::move(given));
}

void read_parameters(const YamlNode& node, Entry& entry, Reading& reading) {
  const std::string path = entry.path + ".parameters";
  if (node.kind == YamlNode::Kind::null) return;
  if (node.kind != YamlNode::Kind::mapping) {
    reading.problems.push_back(
        problem_at(node, path + ": expected a mapping (name: value), found " + found_text(node)));
    return;
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const std::string name = node.keys[i].scalar;
    read_parameter(node.keys[i], node.items[i], path + "." + name, entry, reading);
  }
}

bool is_good_label(const std::string& label) {
  constexpr std::size_t kMostBytes = 100;
  return visible_line(label) == label && !label.empty() && label.size() <= kMostBytes &&
         label.front() != ' ' && label.back() != ' ';
}

/// A mapping's entry, or nothing where its library could not be loaded.
std::optional<Entry> read_mapping(const YamlNode& node, const std::string& path, Reading& reading) {
  Entry entry;
  entry.path = path;
  SpecReader reader(node, path, reading);
  const YamlNode* plugin = reader.take("plugin");
  const YamlNode* label = reader.take("label");
  const YamlNode* parameters = reader.take("parameters");
  const YamlNode* max_speed = nullptr;
  std::optional<PlannerDescription> planner;
  if (plugin == nullptr) {
    reading.problems.push_back(
        problem_at(node, path + ": lacks 'plugin', the planner's name or file"));
  } else {
    const std::size_t before = reading.problems.size();
    read_scalar(*plugin, path + ".plugin", entry.plugin, Range{}, reading.problems);
    if (reading.problems.size() == before) {
      planner = load(*plugin, path + ".plugin", reading);
    }
  }
  if (!planner || parameter_def(*planner, "max_speed_mps") != nullptr) {
    max_speed = reader.take("max_speed_mps");
  }
  reader.finish();
  if (label != nullptr) {
    read_scalar(*label, path + ".label", entry.label, Range{}, reading.problems);
    if (label->kind == YamlNode::Kind::scalar && !is_good_label(entry.label)) {
      reading.problems.push_back(problem_at(
          *label, path + ".label: expected 1 to 100 printable characters without outer spaces"));
    }
  }
  if (!planner) return std::nullopt;
  entry.planner = std::move(*planner);
  if (parameters != nullptr) read_parameters(*parameters, entry, reading);
  if (max_speed != nullptr) {
    YamlNode key = *max_speed;
    key.scalar = "max_speed_mps";
    if (parameters != nullptr && parameters->find(key.scalar) != nullptr) {
      reading.problems.push_back(
          problem_at(*max_speed, path + ".max_speed_mps: is given among the parameters too"));
    } else {
      read_parameter(key, *max_speed, path + ".max_speed_mps", entry, reading);
    }
  }
  return entry;
}

std::optional<Entry> read_entry(const YamlNode& node, const std::string& path, Reading& reading) {
  if (node.kind == YamlNode::Kind::mapping) return read_mapping(node, path, reading);
  if (node.kind != YamlNode::Kind::scalar) {
    reading.problems.push_back(problem_at(
        node, path + ": expected a planner's name or {plugin, label, parameters}, found " +
                  found_text(node)));
    return std::nullopt;
  }
  auto planner = load(node, path, reading);
  if (!planner) return std::nullopt;
  return Entry{path, std::move(*planner), node.scalar, "", {}};
}

std::string value_text(const ParameterDef& def, const ParameterValue& value) {
  return is_number(def) ? number_text(value.number) : value.text;
}

/// The planner for one choice of the given parameters' values; `choice` has an index for each.
PlannerChoice make_choice(const Entry& entry, const std::vector<std::size_t>& choice) {
  const PlannerDescription& planner = entry.planner;
  ParameterValues given;
  std::string swept;
  for (std::size_t i = 0; i < choice.size(); ++i) {
    const GivenParameter& parameter = entry.parameters[i];
    const ParameterValue& value = parameter.values[choice[i]];
    given[parameter.name] = value;
    if (parameter.values.size() < 2) continue;
    swept += (swept.empty() ? "" : ",") + parameter.name + "=" +
             value_text(*parameter_def(planner, parameter.name), value);
  }
  PlannerChoice result;
  result.plugin = entry.plugin;
  result.label = entry.label.empty() ? planner.name : entry.label;
  if (!swept.empty()) result.label += "[" + swept + "]";
  result.file = fs::absolute(planner.file).lexically_normal().string();
  result.file_digest = planner.file_digest;
  result.needs = planner.needs;
  const std::vector<ParameterValue> values = resolve_parameters(planner, given);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterDef& def = planner.parameters[i];
    ParameterChoice parameter{def.name, 0.0, "", !is_number(def)};
    if (parameter.is_text) {
      parameter.text = values[i].text;
    } else {
      parameter.number = values[i].number;
    }
    result.parameters.push_back(std::move(parameter));
  }
  return result;
}

/// The sweep's speed limit, where the planner was given none of its own.
void add_common_speed(const YamlNode& max_speed, const YamlNode& node, Entry& entry,
                      Reading& reading) {
  const std::string name = "max_speed_mps";
  const bool is_given = std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                    [&](const auto& given) { return given.name == name; });
  if (is_given) return;
  if (parameter_def(entry.planner, name) == nullptr) {
    reading.problems.push_back(
        problem_at(node, entry.path + ": " + entry.planner.name +
                             " has no parameter 'max_speed_mps' and can't keep the sweep's"));
    return;
  }
  YamlNode key = max_speed;
  key.scalar = name;
  read_parameter(key, max_speed, name, entry, reading);
}

/// All combinations of the values, the last parameter fastest.
void add_choices(const Entry& entry, const YamlNode& node, std::vector<PlannerChoice>& planners,
                 Reading& reading) {
  constexpr std::size_t kMostChoices = 10'000;
  std::size_t total = 1;
  for (const GivenParameter& parameter : entry.parameters) {
    total *= parameter.values.size();
    if (total > kMostChoices) {
      reading.problems.push_back(problem_at(
          node, entry.path + ": more than " + std::to_string(kMostChoices) + " combinations"));
      return;
    }
  }
  for (std::size_t number = 0; number < total; ++number) {
    std::vector<std::size_t> choice(entry.parameters.size());
    std::size_t rest = number;
    for (std::size_t i = choice.size(); i-- > 0;) {
      choice[i] = rest % entry.parameters[i].values.size();
      rest /= entry.parameters[i].values.size();
    }
    planners.push_back(make_choice(entry, choice));
  }
}

}  // namespace

std::vector<PlannerChoice> read_planners(const YamlNode& node, const YamlNode* max_speed,
                                         Reading& reading) {
  std::vector<PlannerChoice> planners;
  std::map<std::string, std::string> label_owners;
  const std::vector<YamlNode> single{node};
  const bool is_list = node.kind == YamlNode::Kind::list;
  if (node.kind == YamlNode::Kind::null || (is_list && node.items.empty())) {
    reading.problems.push_back(problem_at(node, "planners: expected at least one planner"));
    return planners;
  }
  const std::vector<YamlNode>& nodes = is_list ? node.items : single;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string path = is_list ? "planners[" + std::to_string(i) + "]" : "planners";
    const std::size_t before = reading.problems.size();
    std::optional<Entry> entry = read_entry(nodes[i], path, reading);
    if (entry && max_speed != nullptr) add_common_speed(*max_speed, nodes[i], *entry, reading);
    if (!entry || reading.problems.size() > before) continue;
    const std::size_t first = planners.size();
    add_choices(*entry, nodes[i], planners, reading);
    for (std::size_t k = first; k < planners.size(); ++k) {
      const auto [owner, is_new] = label_owners.emplace(planners[k].label, path);
      if (is_new) continue;
      reading.problems.push_back(problem_at(nodes[i], path + ": the label '" + planners[k].label +
                                                          "' is that of " + owner->second +
                                                          "; give one of them another 'label'"));
    }
  }
  return planners;
}

}  // namespace avoidbench
