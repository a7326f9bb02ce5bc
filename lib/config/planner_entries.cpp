#include "config/planner_entries.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

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

constexpr const char* kMaxSpeed = "max_speed_mps";
constexpr const char* kProcess = "process";  ///< instead of a planner's name: a command starts it
constexpr const char* kWantsCommand =
    "'process' is a planner that a command starts: it needs parameters: {command: [python3, "
    "mine.py]}; without a command of its own, `plugin: ./mine.py` is enough";

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

/// Where a planner is, found by `find(folder)`, and what it says of itself.
template <class Find>
std::optional<PlannerDescription> described(const YamlNode& node, const std::string& path,
                                            Reading& reading, Find&& find) {
  // Relative to the file that says so; what the command line gives, to where it was typed.
  const fs::path folder = folder_of(node, ".");
  try {
    return describe_planner(find(folder));
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      reading.problems.push_back(problem_at(node, path + ": " + text(problem)));
    }
    return std::nullopt;
  }
}

std::optional<PlannerDescription> load(const YamlNode& node, const std::string& path,
                                       Reading& reading) {
  if (node.scalar == kProcess) {
    reading.problems.push_back(problem_at(node, path + ": " + kWantsCommand));
    return std::nullopt;
  }
  return described(node, path, reading, [&](const fs::path& folder) {
    return PlannerSource(find_planner(node.scalar, folder));
  });
}

/// The words of a command: a list of them, or a text that is cut at its spaces.
std::vector<std::string> read_words(const YamlNode& node, const std::string& path,
                                    Reading& reading) {
  std::vector<std::string> words;
  if (node.kind == YamlNode::Kind::list) {
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string at = path + "[" + std::to_string(i) + "]";
      if (const auto word = read_text(node.items[i], at, reading.problems)) words.push_back(*word);
    }
  } else if (const auto text = read_text(node, path, reading.problems)) {
    std::istringstream stream(*text);
    for (std::string word; stream >> word;) words.push_back(word);
  } else {
    return words;
  }
  if (words.empty() || words.front().empty()) {
    reading.problems.push_back(problem_at(node, path + ": expected a program and its arguments"));
    words.clear();
  }
  return words;
}

/// `plugin: process, parameters: {command: …}`: the planner that the command starts. `plugin` gets
/// the name by which it is found again.
std::optional<PlannerDescription> load_command(const YamlNode& plugin, const YamlNode* parameters,
                                               const std::string& path, std::string& name,
                                               Reading& reading) {
  const YamlNode* command = parameters != nullptr ? parameters->find("command") : nullptr;
  if (command == nullptr) {
    reading.problems.push_back(problem_at(plugin, path + ".plugin: " + kWantsCommand));
    return std::nullopt;
  }
  const std::string command_path = path + ".parameters.command";
  const std::vector<std::string> words = read_words(*command, command_path, reading);
  if (words.empty()) return std::nullopt;
  return described(*command, command_path, reading, [&](const fs::path& folder) {
    PlannerSource source = source_of_command(words, folder);
    const auto at = std::find(source.command.begin(), source.command.end(), kFileWord);
    name = words[static_cast<std::size_t>(at - source.command.begin())];
    if (at == source.command.begin()) name = source.file.string();
    // A bare name would be looked for among the installed planners.
    if (name.find('/') == std::string::npos) name.insert(0, "./");
    return source;
  });
}

/// Reads one parameter's value or values, checked by the planner's declaration.
void read_parameter(const YamlNode& key, const std::string& name, const YamlNode& node,
                    const std::string& path, Entry& entry, Reading& reading) {
  const auto problems_of = [&](const ParameterValue& value) {
    return check_parameters(entry.planner, {{name, value}});
  };
  const ParameterDef* def = parameter_def(entry.planner, name);
  if (def == nullptr) {
    // The check of any value says that there is no such parameter, and which is near.
    for (const std::string& problem : problems_of({})) {
      reading.problems.push_back(problem_at(key, entry.path + ".parameters." + problem));
    }
    return;
  }
  GivenParameter given{name, {}};
  const std::vector<YamlNode> items = axis_values(node, path, reading.problems);
  for (const YamlNode& item : items) {
    ParameterValue value;
    if (is_number(*def)) {
      const auto number = read_number(item, path, Range{}, reading.problems);
      if (!number) continue;
      value.number = *number;
    } else {
      const auto text = read_text(item, path, reading.problems);
      if (!text) continue;
      value.text = *text;
      if (items.size() > 1 && visible_line(*text) != *text) {
        reading.problems.push_back(problem_at(
            item,
            path + ": one of several values is part of a label: expected printable characters"));
      }
    }
    for (const std::string& problem : problems_of(value)) {
      // The path names the parameter already.
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
    const std::string& name = node.keys[i].scalar;
    const bool is_command = !entry.planner.command.empty() && name == "command";
    if (is_command) continue;  // read before, since it says whose parameters these are
    read_parameter(node.keys[i], name, node.items[i], path + "." + name, entry, reading);
  }
}

std::string read_label(const YamlNode& node, const std::string& path, Reading& reading) {
  constexpr std::size_t kMostBytes = 100;
  const auto label = read_text(node, path, reading.problems);
  if (!label) return "";
  const bool is_good = visible_line(*label) == *label && !label->empty() &&
                       label->size() <= kMostBytes && label->front() != ' ' && label->back() != ' ';
  if (!is_good) {
    reading.add_problem(path, "expected 1 to 100 printable characters without outer spaces");
  }
  return *label;
}

/// Parameters of the planner that stand beside 'plugin', where they have no meaning.
void refuse_misplaced_parameters(const YamlNode& node, const std::string& path,
                                 const PlannerDescription& planner, MappingReader& mapping,
                                 Reading& reading) {
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const std::string& name = node.keys[i].scalar;
    const bool has_meaning =
        name == "plugin" || name == "label" || name == "parameters" || name == kMaxSpeed;
    if (has_meaning || parameter_def(planner, name) == nullptr) continue;
    mapping.take(name);
    const std::string value = node.items[i].scalar.empty() ? "…" : node.items[i].scalar;
    reading.problems.push_back(problem_at(node.keys[i], path + "." + name + ": a parameter of " +
                                                            planner.name + ": write parameters: {" +
                                                            name + ": " + value + "}"));
  }
}

/// A mapping's entry, or nothing where its library could not be loaded.
std::optional<Entry> read_mapping(const YamlNode& node, const std::string& path, Reading& reading) {
  Entry entry;
  entry.path = path;
  MappingReader mapping(node, path, reading);
  const YamlNode* plugin = mapping.take("plugin");
  const YamlNode* label = mapping.take("label");
  const YamlNode* parameters = mapping.take("parameters");
  std::optional<PlannerDescription> planner;
  if (plugin == nullptr) {
    reading.add_problem(path, "lacks 'plugin', the planner's name or file");
  } else if (const auto name = read_text(*plugin, path + ".plugin", reading.problems)) {
    entry.plugin = *name;
    planner = *name == kProcess ? load_command(*plugin, parameters, path, entry.plugin, reading)
                                : load(*plugin, path + ".plugin", reading);
  }
  const YamlNode* max_speed = nullptr;
  // Of a planner that was not found nobody knows: no second complaint about this key.
  if (!planner || parameter_def(*planner, kMaxSpeed) != nullptr)
    max_speed = mapping.take(kMaxSpeed);
  if (planner) refuse_misplaced_parameters(node, path, *planner, mapping, reading);
  mapping.finish();
  if (label != nullptr) entry.label = read_label(*label, path + ".label", reading);
  if (!planner) return std::nullopt;
  entry.planner = std::move(*planner);
  if (parameters != nullptr) read_parameters(*parameters, entry, reading);
  if (max_speed == nullptr) return entry;
  const std::string speed_path = path + "." + kMaxSpeed;
  if (parameters != nullptr && parameters->find(kMaxSpeed) != nullptr) {
    reading.add_problem(speed_path, "is given among the parameters too");
  } else {
    read_parameter(*max_speed, kMaxSpeed, *max_speed, speed_path, entry, reading);
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

/// The planner with these values; `swept` says those of which there are several.
PlannerChoice make_choice(const Entry& entry, const ParameterValues& given,
                          const std::string& swept) {
  const PlannerDescription& planner = entry.planner;
  PlannerChoice result;
  result.plugin = entry.plugin;
  result.label = entry.label.empty() ? planner.name : entry.label;
  if (!swept.empty()) result.label += "[" + swept + "]";
  result.file = fs::absolute(planner.file).lexically_normal().string();
  result.file_digest = planner.file_digest;
  result.command = planner.command;
  result.files = planner.files;
  result.needs = planner.needs;
  const std::vector<ParameterValue> values = resolve_parameters(planner, given);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterDef& def = planner.parameters[i];
    result.parameters.push_back(
        ParameterChoice{def.name, values[i].number, values[i].text, !is_number(def)});
  }
  return result;
}

/// All combinations of the values from parameter `at` on, the last parameter fastest.
void add_choices(const Entry& entry, std::size_t at, ParameterValues& given,
                 const std::string& swept, std::vector<PlannerChoice>& planners) {
  if (at == entry.parameters.size()) return planners.push_back(make_choice(entry, given, swept));
  const auto& [name, values] = entry.parameters[at];
  const bool is_text = !is_number(*parameter_def(entry.planner, name));
  for (const ParameterValue& value : values) {
    given[name] = value;
    const std::string said = name + "=" + (is_text ? value.text : number_text(value.number));
    const std::string more = swept + (swept.empty() ? "" : ",") + said;
    add_choices(entry, at + 1, given, values.size() > 1 ? more : swept, planners);
  }
}

/// The sweep's speed limit, where the planner was given none of its own.
void add_common_speed(const YamlNode& max_speed, const YamlNode& node, Entry& entry,
                      Reading& reading) {
  const bool is_given = std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                    [](const auto& given) { return given.name == kMaxSpeed; });
  if (is_given) return;
  if (parameter_def(entry.planner, kMaxSpeed) == nullptr) {
    reading.problems.push_back(
        problem_at(node, entry.path + ": " + entry.planner.name +
                             " has no parameter 'max_speed_mps' and can't keep the sweep's"));
    return;
  }
  read_parameter(max_speed, kMaxSpeed, max_speed, kMaxSpeed, entry, reading);
}

/// Whether there are not too many combinations.
bool check_count(const Entry& entry, const YamlNode& node, Reading& reading) {
  constexpr std::size_t kMostChoices = 10'000;
  std::size_t total = 1;
  for (const GivenParameter& parameter : entry.parameters) {
    total *= parameter.values.size();
    if (total <= kMostChoices) continue;
    reading.problems.push_back(problem_at(
        node, entry.path + ": more than " + std::to_string(kMostChoices) + " combinations"));
    return false;
  }
  return true;
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
    // What is wrong with it was told; its labels could only bring more.
    if (!entry || reading.problems.size() > before) continue;
    const std::size_t first = planners.size();
    ParameterValues given;
    if (check_count(*entry, nodes[i], reading)) add_choices(*entry, 0, given, "", planners);
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
