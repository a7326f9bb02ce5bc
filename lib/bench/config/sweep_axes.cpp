#include "config/sweep_axes.hpp"

#include <algorithm>
#include <set>

#include "base/json_path.hpp"
#include "config/field_reader.hpp"
#include "config/sweep_keys.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;
using Check = std::function<void(const TrialSpec&)>;

/// {a: {b: value}} for "a.b"; every level stands at the place of `key`.
/// So that an axis' value is read by the reader of blocks, with the same checks and messages.
YamlNode nested(const std::string& path, const YamlNode& key, const YamlNode& value) {
  const std::size_t dot = path.find('.');
  const bool is_last = dot == std::string::npos;
  return mapping_at(key, path.substr(0, dot),
                    is_last ? value : nested(path.substr(dot + 1), key, value));
}

/// Why `path` can't be an axis, or "".
std::string path_problem(const std::string& path, const FieldTree& trial, const Json& base) {
  const std::string first = path.substr(0, path.find('.'));
  if (first == "planner" || first == "planners") {
    return "write a planner's parameters as lists in its entry of 'planners'";
  }
  if (first == "mission_index" || first == "trials")
    return "'trials' says how many missions there are";
  if (first == "latency_digest" || first == "missions_digest" || first == "recording")
    return "the program fills it in";
  if (path == "mission.list" || path == "mission.file")
    return "all missions are flown for each setting";
  if (path.find('[') != std::string::npos)
    return "elements of lists can't be axes; give complete lists";
  if (path.empty() || path.front() == '.' || path.back() == '.' ||
      // These have a meaning in JSON pointers.
      path.find("..") != std::string::npos || path.find_first_of("/~") != std::string::npos) {
    return "not a dotted path such as wind.mean_world_mps";
  }
  // A variant's kind brings other fields with it, which would be missing or unknown for some of the
  // axis' values.
  for (const KindField& found : fields_at(trial, path)) {
    if (found.field->kind != FieldKind::variant) continue;
    return "a " + found.field->name + " can't be an axis; write one sweep for each";
  }
  if (base.contains(json_place(path)) && base.at(json_place(path)).is_object()) {
    return "is a group of fields, not one";
  }
  return "";
}

void read_axis(const GivenValue& key, const YamlNode& values, SweepSpec& sweep) {
  static const FieldTree trial_tree = field_tree("", TrialSpec{}, "");
  const Json base = spec_to_json(sweep.base);
  const std::string path = trial_path(key.node.scalar);
  const bool is_second = axis_of(sweep, path) != nullptr;
  const std::string problem =
      is_second ? "already has several values above" : path_problem(path, trial_tree, base);
  if (!problem.empty()) {
    key.add_problem(problem);
    return;
  }
  // An axis of thousands of wrong values has said enough.
  constexpr std::size_t kMostProblems = 5;
  Axis axis{path, {}};
  Reading found;  // of its own: the places of blocks are those of the blocks
  for (const YamlNode& value : axis_values({values, key.path, found})) {
    Json trial = base;
    // Into a whole trial: a field of a kind is there only in a trial of that kind.
    read_block({nested(path, key.node, value), "", found}, trial_tree, trial);
    if (found.problems.size() >= kMostProblems) break;
    if (found.problems.empty()) axis.values.push_back(trial.at(json_place(path)));
  }
  std::vector<InputProblem>& problems = key.reading.problems;
  key.reading.remember(sweep_path(path), key.node);
  problems.insert(problems.end(), found.problems.begin(), found.problems.end());
  if (found.problems.empty()) sweep.axes.push_back(std::move(axis));
}

/// All combinations from this axis on.
void combine(const std::vector<Axis>& axes, std::size_t at, Json& trial, const Check& check) {
  // Trials are made from JSON only at the end of a combination.
  if (at == axes.size()) return check(spec_from_json<TrialSpec>(trial));
  for (const Json& value : axes[at].values) {
    trial.at(json_place(axes[at].path)) = value;
    combine(axes, at + 1, trial, check);
  }
}

}  // namespace

void read_axes(const GivenValue& given, SweepSpec& sweep) {
  const YamlNode& node = given.node;
  if (node.kind == YamlNode::Kind::null) return;
  if (node.kind != YamlNode::Kind::mapping) given.add_expected("a mapping {path: [values]}");
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    read_axis(given.at(node.keys[i], node.keys[i].scalar), node.items[i], sweep);
  }
}

Axis* axis_of(SweepSpec& sweep, const std::string& path) {
  const auto found = std::find_if(sweep.axes.begin(), sweep.axes.end(),
                                  [&](const Axis& axis) { return axis.path == path; });
  return found != sweep.axes.end() ? &*found : nullptr;
}

void for_each_combination(const SweepSpec& sweep, const Check& check) {
  constexpr double kMostCombinations = 4096;
  double total = 1.0;
  for (const Axis& axis : sweep.axes) total *= static_cast<double>(axis.values.size());
  Json first = spec_to_json(sweep.base);
  if (total <= kMostCombinations) return combine(sweep.axes, 0, first, check);
  // Too many to look at all: each axis by itself, the others at their first values.
  for (const Axis& axis : sweep.axes) first.at(json_place(axis.path)) = axis.values.front();
  for (const Axis& axis : sweep.axes) {
    Json trial = first;
    combine({axis}, 0, trial, check);
  }
}

std::vector<SensorSpec> swept_sensors(const SweepSpec& sweep) {
  SweepSpec alone = sweep;
  std::erase_if(alone.axes, [](const Axis& axis) { return !axis.path.starts_with("sensor"); });
  std::vector<SensorSpec> sensors;
  std::set<std::string> known;
  for_each_combination(alone, [&](const TrialSpec& trial) {
    if (known.insert(spec_to_json(trial.sensor).dump()).second) sensors.push_back(trial.sensor);
  });
  return sensors;
}

std::string goals_demand(const SweepSpec& sweep) {
  bool has_several =
      std::any_of(sweep.missions.begin(), sweep.missions.end(),
                  [](const ListedMission& one) { return !one.mission.waypoints_world.empty(); });
  bool has_motion = false;
  SweepSpec alone = sweep;
  std::erase_if(alone.axes, [](const Axis& axis) { return !axis.path.starts_with("mission."); });
  for_each_combination(alone, [&](const TrialSpec& trial) {
    const MissionSpec& rules = trial.mission;
    has_several = has_several || rules.waypoints > 0 || rules.return_to_start;
    has_motion = has_motion || rules.goal_motion.path != GoalPath::none;
  });
  if (has_several) return "several goals";
  return has_motion ? "a goal that moves" : "";
}

}  // namespace avoidbench
