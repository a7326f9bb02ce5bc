#include "config/given_values.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/output_file.hpp"
#include "base/words.hpp"
#include "config/field_reader.hpp"
#include "config/sweep_axes.hpp"
#include "config/sweep_keys.hpp"
#include "trial/contradictions.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

/// The value of a path of the file, in its block or among the axes; null where it is not given.
const YamlNode* given(const YamlNode& root, const std::string& path) {
  // Of two parts: a block of the sweep, and its key.
  const std::size_t dot = path.find('.');
  if (const YamlNode* block = root.find(path.substr(0, dot))) {
    if (const YamlNode* value = block->find(path.substr(dot + 1))) return value;
  }
  const YamlNode* axes = root.find("axes");
  return axes == nullptr ? nullptr : axes->find(path);
}

/// Whether two values were written together: in one file, or both on the command line.
bool are_together(const YamlNode& a, const YamlNode& b) {
  const auto origin = [](const YamlNode& node) {
    // Overrides have no line; their sources, one option each, are one origin.
    return node.line == 0 || !node.source ? std::string() : *node.source;
  };
  return origin(a) == origin(b);
}

/// Whether the value is the default: a file may write out all there is, as `config defaults` does.
bool is_default(const YamlNode& node, const nlohmann::json& preset) {
  if (preset.is_string()) return node.items.empty() && node.scalar == preset.get<std::string>();
  return number_of(node) == preset.get<double>();
}

/// A key of `latency` that none of the modes has a use for. Where a file that includes another one,
/// or the command line, changes the mode, what belonged to the former one is left aside.
void check_latency(const YamlNode& root, const std::set<LatencyMode>& modes, Reading& reading) {
  struct Use {
    const char* key;
    nlohmann::json preset;
    std::vector<LatencyMode> modes;
  };
  const LatencySpec preset;
  const Use uses[] = {{"ms", preset.ms, {LatencyMode::fixed}},
                      {"scale", preset.scale, {LatencyMode::measured, LatencyMode::replay}},
                      {"database", preset.database, {LatencyMode::replay}}};
  const YamlNode* mode = given(root, "latency.mode");
  for (const Use& use : uses) {
    const std::string path = std::string("latency.") + use.key;
    const YamlNode* value = given(root, path);
    if (value == nullptr || mode == nullptr || !are_together(*mode, *value)) continue;
    // At its default it changes nothing, whatever the mode.
    if (is_default(*value, use.preset)) continue;
    const bool is_used = std::any_of(use.modes.begin(), use.modes.end(),
                                     [&](LatencyMode one) { return modes.contains(one); });
    if (is_used) continue;
    std::vector<std::string> present, wanted;
    for (const LatencyMode one : modes) present.emplace_back(text(one));
    for (const LatencyMode one : use.modes) wanted.emplace_back(text(one));
    GivenValue{*value, path, reading}.add_problem(
        "has no effect in mode " + joined(present, " and ") +
        "; leave it out, or write mode: " + joined(wanted, " or "));
  }
}

/// Heights of starts and goals above the floor; 0 where the map comes from a file.
double flight_height_m(const MapSpec& map) {
  // By the fields that the map's spec has: from a file, in the original's way, or any other.
  return std::visit(
      [](const auto& spec) {
        if constexpr (requires { spec.bounds; }) {
          return 0.0;
        } else if constexpr (requires { spec.start_height_m; }) {
          return spec.start_height_m;
        } else {
          return spec.flight_height_m;
        }
      },
      map);
}

/// The greatest distance of a start and a goal of the regions that were given, in plan; infinite
/// where none were.
double longest_flight_m(const MapSpec& map) {
  return std::visit(
      [](const auto& spec) {
        if constexpr (requires { spec.start_region; }) {
          const BoxSpec &start = spec.start_region, &goal = spec.goal_region;
          double square_m2 = 0.0;
          for (std::size_t axis = 0; axis < 2; ++axis) {
            for (const BoxSpec* box : {&start, &goal}) {
              if (box->lowest_m.size() != 3 || box->highest_m.size() != 3) return HUGE_VAL;
            }
            // The farthest corners of the two boxes, axis by axis.
            const double most_m = std::max(std::abs(goal.highest_m[axis] - start.lowest_m[axis]),
                                           std::abs(start.highest_m[axis] - goal.lowest_m[axis]));
            square_m2 += most_m * most_m;
          }
          return std::sqrt(square_m2);
        }
        return HUGE_VAL;
      },
      map);
}

/// Whether no floor is within the free space around starts and goals; true for maps from files.
bool has_room_above_floor(const TrialSpec& trial) {
  const double height_m = flight_height_m(trial.map);
  return height_m == 0.0 || trial.mission.free_radius_m <= height_m;
}

/// A key of `vehicle` that follows from another one, of which one of these values is not 0; where
/// both stand in the block itself its reader has said so.
void check_vehicle_keys(const YamlNode& root, const nlohmann::json& vehicle,
                        std::set<const YamlNode*>& told, Reading& reading) {
  for (const FieldTree& field : vehicle_tree().fields) {
    if (field.settles.empty() || vehicle.at(field.name) == 0.0) continue;
    for (const std::string& name : field.settles) {
      const YamlNode* value = given(root, "vehicle." + name);
      if (value == nullptr || !told.insert(value).second) continue;
      GivenValue{*value, "vehicle." + name, reading}.add_problem(follows_text(field, vehicle));
    }
  }
}

/// Those of one trial's rules; `is_given` says whether the file has a path.
template <class IsGiven>
std::vector<Contradiction> problems_of(const TrialSpec& trial, IsGiven is_given) {
  const MissionSpec& mission = trial.mission;
  std::vector<Contradiction> problems;
  const std::string goal = number_text(mission.goal_radius_m) + " m";
  const std::string free = number_text(mission.free_radius_m) + " m";
  if (is_given("mission.goal_radius_m") && mission.goal_radius_m > mission.free_radius_m) {
    problems.push_back({"mission.goal_radius_m",
                        goal + " is above free_radius_m, " + free +
                            ": a flight would end at the goal with obstacles between them"});
  }
  const double longest_m = longest_flight_m(trial.map);
  if (mission.goal_radius_m >= longest_m) {
    problems.push_back({"mission.goal_radius_m",
                        goal + " is not below the greatest distance from start_region to " +
                            // In whole centimetres.
                            "goal_region, " + number_text(std::round(100.0 * longest_m) / 100.0) +
                            " m: every flight is over before it begins"});
  }
  if (mission.goal_motion.path != GoalPath::none && mission.return_to_start) {
    problems.push_back({"mission.return_to_start",
                        "the last goal is then the start, which can't move: leave it out, or "
                        "mission.goal_motion"});
  }
  const double height_m = flight_height_m(trial.map);
  if (is_given("mission.free_radius_m") && !has_room_above_floor(trial)) {
    problems.push_back(
        {"mission.free_radius_m", free + " is above the flight height, " + number_text(height_m) +
                                      " m: the floor is nearer than that to every start and goal"});
  }
  const LatencySpec& latency = trial.latency;
  if (latency.mode == LatencyMode::fixed && latency.ms >= 1000.0 * mission.time_limit_s) {
    problems.push_back(
        {"latency.ms", number_text(latency.ms) + " ms is not below mission.time_limit_s, " +
                           number_text(mission.time_limit_s) + " s: no command would take effect"});
  }
  return problems;
}

}  // namespace

void throw_problems(std::vector<InputProblem> problems, const std::string& main_file) {
  // Other files follow in the order of their first problem; the command line comes last.
  std::map<std::string, std::size_t> file_order{{main_file, 0}};
  for (const InputProblem& problem : problems) {
    const bool is_file = problem.line > 0;  // or an option of the command line
    file_order.emplace(problem.file, is_file ? file_order.size() : problems.size() + 1);
  }
  const auto key = [&](const InputProblem& problem) {
    return std::tuple(file_order.at(problem.file), problem.line, problem.column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::set<std::string> seen;
  std::erase_if(problems, [&](const auto& problem) { return !seen.insert(text(problem)).second; });
  throw InputError(std::move(problems));
}

void check_name(const GivenValue& root, const std::string& key, const std::string& name) {
  const YamlNode* node = root.node.find(key);
  if (node == nullptr) {
    root.add_problem("lacks '" + key + "', the name of the result set");
  } else if (node->kind == YamlNode::Kind::scalar && safe_file_name(name) != name) {
    // The name becomes that of a file.
    root.at(*node, key)
        .add_problem(found_text(*node) +
                     " is not a name of A-Z a-z 0-9 _ . - that begins with a letter, digit or _");
  }
}

bool fits_free_space(const TrialSpec& trial) {
  return has_room_above_floor(trial) && trial.mission.goal_radius_m <= trial.mission.free_radius_m;
}

void check_given_values(const YamlNode& root, const SweepSpec& sweep, Reading& reading) {
  std::set<LatencyMode> modes;
  std::set<const YamlNode*> told;
  const auto is_given = [&](const std::string& path) { return given(root, path) != nullptr; };
  for_each_combination(sweep, [&](const TrialSpec& trial) {
    modes.insert(trial.latency.mode);
    check_vehicle_keys(root, spec_to_json(trial.vehicle), told, reading);
    for (const Contradiction& found : problems_of(trial, is_given)) {
      reading.at(found.path).add_problem(found.message);
    }
  });
  check_latency(root, modes, reading);
}

}  // namespace avoidbench
