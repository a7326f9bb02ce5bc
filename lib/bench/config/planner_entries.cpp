#include "config/planner_entries.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "plugin/planner_library.hpp"
#include "plugin/planner_table.hpp"
#include "trial/planner_view.hpp"
#include "yaml/includes.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// A parameter with the values it was given, at least one.
struct GivenParameter {
  std::string name;
  std::vector<ParameterValue> values;
};

constexpr const char* kMaxSpeed = "max_speed_mps";
constexpr const char* kCamera = "camera";
constexpr const char* kFilter = "filter";
constexpr const char* kProcess = "process";  ///< instead of a planner's name: a command starts it
constexpr const char* kWantsCommand =
    "'process' is a planner that a command starts: it needs parameters: {command: [python3, "
    "mine.py]}; if it needs no special command, `plugin: ./mine.py` is enough";

struct Entry {
  PlannerDescription planner;
  std::string plugin, label;
  std::vector<GivenParameter> parameters;
  std::int64_t camera = kAllCameras;
  std::vector<Entry> filter = {};  ///< one or none
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
std::optional<PlannerDescription> described(const GivenValue& given, Find&& find) {
  try {
    // Relative to the file that says so; what the command line gives, to where it was typed.
    return describe_planner(find(folder_of(given.node, ".")));
  } catch (const InputError& error) {
    return given.add_problems(error);
  }
}

std::optional<PlannerDescription> load(const GivenValue& given) {
  const std::string& name = given.node.scalar;
  if (name == kProcess) return given.add_problem(kWantsCommand);
  return described(
      given, [&](const fs::path& folder) { return PlannerSource(find_planner(name, folder)); });
}

/// The words of a command: a list of them, or a text that is cut at its spaces.
std::vector<std::string> read_words(const GivenValue& given) {
  std::vector<std::string> words;
  if (given.node.kind == YamlNode::Kind::list) {
    for (const GivenValue& element : given.elements()) {
      if (const auto word = read_text(element)) words.push_back(*word);
    }
  } else if (const auto text = read_text(given)) {
    std::istringstream stream(*text);
    for (std::string word; stream >> word;) words.push_back(word);
  } else {
    return words;
  }
  if (words.empty() || words.front().empty()) {
    given.add_problem("expected a program and its arguments");
    words.clear();
  }
  return words;
}

/// `plugin: process, parameters: {command: …}`: the planner that the command starts. `name` gets
/// that by which it is found again.
std::optional<PlannerDescription> load_command(const GivenValue& plugin,
                                               const std::optional<GivenValue>& parameters,
                                               std::string& name) {
  const YamlNode* node = parameters ? parameters->node.find("command") : nullptr;
  if (node == nullptr) return plugin.add_problem(kWantsCommand);
  const GivenValue command = parameters->at(*node, "command");
  const std::vector<std::string> words = read_words(command);
  if (words.empty()) return std::nullopt;
  return described(command, [&](const fs::path& folder) {
    PlannerSource source = source_of_command(words, folder);
    const auto at = std::find(source.command.begin(), source.command.end(), kFileWord);
    name = words[static_cast<std::size_t>(at - source.command.begin())];
    if (at == source.command.begin()) name = source.file.string();
    // A bare name would be looked for among the installed planners.
    if (name.find('/') == std::string::npos) name.insert(0, "./");
    return source;
  });
}

/// What the planner says against a value; against any that there is no such parameter, and which is
/// near.
void check_value(const GivenValue& given, const std::string& name, const ParameterValue& value,
                 const PlannerDescription& planner) {
  for (const std::string& problem : check_parameters(planner, {{name, value}})) {
    // The path names the parameter already.
    given.add_problem(problem.substr(name.size() + 2));
  }
}

/// Reads the value or values of one of the planner's parameters.
void read_parameter(const GivenValue& given, const std::string& name, Entry& entry) {
  const bool has_number = is_number(*parameter_def(entry.planner, name));
  GivenParameter parameter{name, {}};
  const std::vector<YamlNode> items = axis_values(given);
  for (const YamlNode& item : items) {
    const GivenValue one{item, given.path, given.reading};
    const auto number = has_number ? read_number(one, Range{}) : std::nullopt;
    const auto text = has_number ? std::nullopt : read_text(one);
    if (!number && !text) continue;
    if (text && items.size() > 1 && visible_line(*text) != *text) {
      one.add_problem("one of several values is part of a label: expected printable characters");
    }
    parameter.values.push_back({number.value_or(0.0), text.value_or("")});
    check_value(one, name, parameter.values.back(), entry.planner);
  }
  if (!parameter.values.empty()) entry.parameters.push_back(std::move(parameter));
}

void read_parameters(const GivenValue& given, Entry& entry) {
  const YamlNode& node = given.node;
  if (node.kind == YamlNode::Kind::null) return;
  if (node.kind != YamlNode::Kind::mapping) given.add_expected("a mapping (name: value)");
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const std::string& name = node.keys[i].scalar;
    const bool is_command = !entry.planner.command.empty() && name == "command";
    if (is_command) continue;  // read before, since it says whose parameters these are
    if (parameter_def(entry.planner, name) != nullptr) {
      read_parameter(given.at(node.items[i], name), name, entry);
    } else {
      check_value(given.at(node.keys[i], name), name, {}, entry.planner);
    }
  }
}

std::string read_label(const GivenValue& given) {
  constexpr std::size_t kMostBytes = 100;
  const auto label = read_text(given);
  if (!label) return "";
  const bool is_good = visible_line(*label) == *label && !label->empty() &&
                       label->size() <= kMostBytes && label->front() != ' ' && label->back() != ' ';
  if (!is_good) given.add_problem("expected 1 to 100 printable characters without outer spaces");
  return *label;
}

/// Parameters of the planner that stand beside 'plugin', where they have no meaning.
void refuse_misplaced_parameters(const GivenValue& given, const PlannerDescription& planner,
                                 MappingReader& mapping) {
  for (std::size_t i = 0; i < given.node.keys.size(); ++i) {
    const std::string& name = given.node.keys[i].scalar;
    const bool has_meaning = name == "plugin" || name == "label" || name == "parameters" ||
                             name == kCamera || name == kFilter || name == kMaxSpeed;
    if (has_meaning || parameter_def(planner, name) == nullptr) continue;
    mapping.take(name);
    const std::string& scalar = given.node.items[i].scalar;
    given.at(given.node.keys[i], name)
        .add_problem("a parameter of " + planner.name + ": write parameters: {" + name + ": " +
                     (scalar.empty() ? "…" : scalar) + "}");
  }
}

/// The index of the one camera that the planner is to see.
std::int64_t read_camera(const GivenValue& given, const PlannerDescription& planner) {
  if (!sees_images(planner.needs)) given.add_problem(planner.name + " sees no images");
  return read_whole<std::int64_t>(given, Range{0, 10000}).value_or(kAllCameras);
}

/// "0 (yaw 0°), 1 (yaw 90°)": the cameras of a rig, by index.
std::string camera_list(const std::vector<RigCamera>& cameras) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const MountingSpec& mounting = cameras[i].mounting;
    texts.push_back(
        std::to_string(i) + " (yaw " + number_text(mounting.yaw_deg) + "°" +
        (mounting.pitch_deg == 0.0 ? "" : ", pitch " + number_text(mounting.pitch_deg) + "°") +
        ")");
  }
  return joined(texts);
}

/// Adds why the planner can't fly with this sensor.
void check_sensor(const GivenValue& given, const Entry& entry, const SensorSpec& sensor) {
  const std::string name = "sensor '" + sensor.name + "'";
  const std::vector<RigCamera> cameras = rig_cameras(sensor);
  const auto count = static_cast<std::int64_t>(cameras.size());
  if (entry.camera >= count) {
    given.add_problem(name + " has no camera " + std::to_string(entry.camera) + "; it has " +
                      camera_list(cameras));
    return;
  }
  TrialSpec trial;
  trial.sensor = sensor;
  trial.planner.camera = entry.camera;
  const std::string problem = sensor_problem(entry.planner, planner_setup(trial));
  if (problem.empty()) return;
  const bool may_choose =
      (entry.planner.needs & AB_INPUT_ONE_CAMERA) != 0 && entry.camera == kAllCameras && count > 1;
  given.add_problem(entry.planner.name + " can't fly with " + name + ": " + problem +
                    (may_choose ? "; name the one that it sees, as in {plugin: " + entry.plugin +
                                      ", camera: 0}, of " + camera_list(cameras)
                                : ""));
}

std::optional<Entry> read_filter(const GivenValue& given, const PlannerDescription& planner);

/// What else a planner's entry has, which a filter's has not.
struct PlannerKeys {
  std::optional<GivenValue> camera, filter, max_speed;
};

void read_planner_keys(const PlannerKeys& keys, const std::optional<GivenValue>& parameters,
                       Entry& entry) {
  if (keys.camera) entry.camera = read_camera(*keys.camera, entry.planner);
  if (keys.filter) {
    if (auto filter = read_filter(*keys.filter, entry.planner)) {
      filter->camera = entry.camera;
      entry.filter.push_back(std::move(*filter));
    }
  }
  if (keys.max_speed && parameters && parameters->node.find(kMaxSpeed) != nullptr) {
    keys.max_speed->add_problem("is also given among the parameters");
  } else if (keys.max_speed) {
    read_parameter(*keys.max_speed, kMaxSpeed, entry);
  }
}

/// A mapping's entry, or nothing where its library could not be loaded.
std::optional<Entry> read_mapping(const GivenValue& given, bool of_filter) {
  Entry entry;
  MappingReader mapping(given);
  const auto plugin = mapping.take("plugin");
  const auto label = mapping.take("label");
  const auto parameters = mapping.take("parameters");
  const auto camera = of_filter ? std::nullopt : mapping.take(kCamera);
  const auto filter = of_filter ? std::nullopt : mapping.take(kFilter);
  std::optional<PlannerDescription> planner;
  if (!plugin) {
    given.add_problem("lacks 'plugin', the planner's name or file");
  } else if (const auto name = read_text(*plugin)) {
    entry.plugin = *name;
    planner = *name == kProcess ? load_command(*plugin, parameters, entry.plugin) : load(*plugin);
  }
  // Of a planner that was not found nobody knows: no second complaint about this key or others.
  const bool has_speed = !of_filter && (!planner || parameter_def(*planner, kMaxSpeed) != nullptr);
  const auto max_speed = has_speed ? mapping.take(kMaxSpeed) : std::nullopt;
  if (planner) refuse_misplaced_parameters(given, *planner, mapping);
  if (planner) mapping.finish();
  if (label) entry.label = read_label(*label);
  if (!planner) return std::nullopt;
  entry.planner = std::move(*planner);
  if (parameters) read_parameters(*parameters, entry);
  read_planner_keys({camera, filter, max_speed}, parameters, entry);
  return entry;
}

std::optional<Entry> read_entry(const GivenValue& given, bool of_filter) {
  if (given.node.kind == YamlNode::Kind::mapping) return read_mapping(given, of_filter);
  if (given.node.kind != YamlNode::Kind::scalar) {
    return given.add_expected(std::string(of_filter ? "a filter" : "a planner") +
                              "'s name or {plugin, label, parameters}");
  }
  auto planner = load(given);
  if (!planner) return std::nullopt;
  return Entry{std::move(*planner), given.node.scalar, "", {}, kAllCameras};
}

/// What the planner's commands are to pass through.
std::optional<Entry> read_filter(const GivenValue& given, const PlannerDescription& planner) {
  std::optional<Entry> filter = read_entry(given, true);
  if (!filter) return std::nullopt;
  const std::string problem = filter_problem(filter->planner, planner);
  if (!problem.empty()) return given.add_problem(problem);
  return filter;
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
  result.camera = entry.camera;
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

/// The planner's choices from `first` on, each with each of its filter's. A filter is part of the
/// label, except where the user gave one and there is nothing to tell apart.
void add_filters(const Entry& entry, std::size_t first, std::vector<PlannerChoice>& planners) {
  if (entry.filter.empty()) return;
  std::vector<PlannerChoice> filters;
  ParameterValues values;
  add_choices(entry.filter.front(), 0, values, "", filters);
  const std::vector<PlannerChoice> alone(planners.begin() + static_cast<std::ptrdiff_t>(first),
                                         planners.end());
  planners.resize(first);
  for (const PlannerChoice& planner : alone) {
    for (const PlannerChoice& filter : filters) {
      PlannerChoice& both = planners.emplace_back(planner);
      both.filter = filter;
      if (entry.label.empty() || filters.size() > 1) both.label += " + " + filter.label;
    }
  }
}

/// The sweep's speed limit, where the planner was given none of its own.
void add_common_speed(const YamlNode& max_speed, const GivenValue& given, Entry& entry) {
  const bool is_given = std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                    [](const auto& other) { return other.name == kMaxSpeed; });
  if (is_given) return;
  if (parameter_def(entry.planner, kMaxSpeed) == nullptr) {
    given.add_problem(entry.planner.name +
                      " has no parameter 'max_speed_mps' and can't keep the sweep's");
    return;
  }
  read_parameter({max_speed, kMaxSpeed, given.reading}, kMaxSpeed, entry);
}

/// Whether there are not too many combinations.
bool check_count(const Entry& entry, const GivenValue& given) {
  constexpr std::size_t kMostChoices = 10'000;
  std::size_t total = 1;
  std::vector<GivenParameter> parameters = entry.parameters;
  for (const Entry& filter : entry.filter) {
    parameters.insert(parameters.end(), filter.parameters.begin(), filter.parameters.end());
  }
  for (const GivenParameter& parameter : parameters) {
    total *= parameter.values.size();
    if (total <= kMostChoices) continue;
    given.add_problem("more than " + std::to_string(kMostChoices) + " combinations");
    return false;
  }
  return true;
}

}  // namespace

std::vector<PlannerChoice> read_planners(const GivenValue& given, const YamlNode* max_speed,
                                         const std::vector<SensorSpec>& sensors,
                                         const std::string& goals) {
  std::vector<PlannerChoice> planners;
  std::map<std::string, std::string> label_owners;
  // One planner stands for a list of one.
  const bool is_one =
      given.node.kind == YamlNode::Kind::scalar || given.node.kind == YamlNode::Kind::mapping;
  const std::vector<GivenValue> entries = is_one ? std::vector{given} : given.elements();
  if (entries.empty()) given.add_problem("expected at least one planner");
  for (const GivenValue& one : entries) {
    const std::size_t before = given.reading.problems.size();
    std::optional<Entry> entry = read_entry(one, false);
    if (entry) {
      const std::string problem = filter_alone_problem(entry->planner);
      if (!problem.empty()) one.add_problem(problem);
    }
    if (entry && max_speed != nullptr) add_common_speed(*max_speed, one, *entry);
    if (entry) {
      for (const SensorSpec& sensor : sensors) {
        check_sensor(one, *entry, sensor);
        for (const Entry& filter : entry->filter) check_sensor(one, filter, sensor);
      }
      if (!goals.empty() && (entry->planner.needs & AB_INPUT_GOALS) == 0) {
        one.add_problem(entry->planner.name + " can't fly these missions: they have " + goals +
                        ", and it does not declare AB_INPUT_GOALS");
      }
    }
    // What is wrong with it was told; its labels could only bring more.
    if (!entry || given.reading.problems.size() > before) continue;
    const std::size_t first = planners.size();
    ParameterValues values;
    if (check_count(*entry, one)) {
      add_choices(*entry, 0, values, "", planners);
      add_filters(*entry, first, planners);
    }
    for (std::size_t k = first; k < planners.size(); ++k) {
      const auto [owner, is_new] = label_owners.emplace(planners[k].label, one.path);
      if (is_new) continue;
      one.add_problem("the label '" + planners[k].label + "' is that of " + owner->second +
                      "; give one of them another 'label'");
    }
  }
  return planners;
}

}  // namespace avoidbench
