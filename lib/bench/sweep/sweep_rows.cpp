#include "sweep/sweep_rows.hpp"

#include <algorithm>
#include <filesystem>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "plugin/planner_description.hpp"
#include "sweep/recorded_latency.hpp"

namespace avoidbench {
namespace {

std::string file_name(const nlohmann::json& path) {
  return std::filesystem::path(path.get<std::string>()).filename().string();
}

nlohmann::json axis_json(const Axis& axis) {
  nlohmann::json values = axis.values;
  if (axis.path == "map.file" || axis.path == "wind.field.file") {
    for (nlohmann::json& value : values) {
      const std::string file = value.get<std::string>();
      // A name alone would not say which contents were flown.
      value = {{"file", file}, {"file_digest", file.empty() ? "" : file_digest(file)}};
      forget_folder(value);
    }
  }
  if (axis.path == "latency.database") {
    // The name is enough: latency_digest says what was in it.
    for (nlohmann::json& value : values) value = file_name(value);
  }
  return {{"path", axis.path}, {"values", values}};
}

nlohmann::json missions_json(const std::vector<ListedMission>& listed) {
  nlohmann::json all = nlohmann::json::array();
  for (const ListedMission& one : listed) {
    const auto& [start, goal, yaw_rad, waypoints] = one.mission;
    all.push_back({{"map", one.map},
                   {"start", {start.x(), start.y(), start.z()}},
                   {"goal", {goal.x(), goal.y(), goal.z()}},
                   {"start_yaw_rad", yaw_rad}});
    for (const Eigen::Vector3d& place : waypoints) {
      all.back()["waypoints"].push_back({place.x(), place.y(), place.z()});
    }
  }
  return all;
}

/// Replayed latencies as one digest; "" where none are.
std::string replayed_digest(const std::vector<PlannedTrial>& trials) {
  Digest digest;
  bool is_replay = false;
  for (const PlannedTrial& trial : trials) {
    is_replay = is_replay || trial.setting->latency.mode == LatencyMode::replay;
    digest.add(trial.latency_digest);
  }
  return is_replay ? digest.hex() : "";
}

/// What all trials share, without what the mode of latency has no use for, unless an axis does.
nlohmann::json base_json(const SweepSpec& sweep, const std::vector<PlannedTrial>& trials) {
  const bool is_swept = std::any_of(sweep.axes.begin(), sweep.axes.end(), [](const Axis& axis) {
    return axis.path.starts_with("latency.");
  });
  nlohmann::json base = spec_to_json(is_swept ? sweep.base : without_unused_latency(sweep.base));
  base.erase("planner");    // the planners stand beside it
  base.erase("recording");  // so do those
  forget_folders(base);
  base["latency"]["database"] = file_name(base["latency"]["database"]);
  base["latency_digest"] = replayed_digest(trials);
  return base;
}

/// The planner's file_digest says which library it was, wherever that lay; so does the filter's. No
/// filter is none: databases have the bytes that they had before there were any.
void forget_plugin_files(nlohmann::json& planner) {
  planner.erase("file");
  if (planner["filter"].is_null()) {
    planner.erase("filter");
  } else {
    planner["filter"].erase("file");
  }
}

}  // namespace

/// Databases keep no paths: they are of one machine, and may tell of its owner.
void forget_folder(nlohmann::json& block) {
  if (!block.contains("file")) return;
  block["file"] = file_name(block["file"]);
}

void forget_folders(nlohmann::json& trial) {
  forget_folder(trial["map"]);
  forget_folder(trial["wind"]["field"]);
}

std::string trial_json(const TrialSpec& spec) {
  // Keys are sorted by name: equal specs have equal texts.
  nlohmann::json canonical = spec_to_json(without_unused_latency(spec));
  forget_plugin_files(canonical["planner"]);
  forget_folders(canonical);
  if (!spec.recording) canonical.erase("recording");  // as filters, above
  return canonical.dump();
}

std::string sweep_json(const SweepSpec& sweep, const std::vector<PlannedTrial>& trials) {
  nlohmann::json axes = nlohmann::json::array(), planners = nlohmann::json::array();
  for (const Axis& axis : sweep.axes) axes.push_back(axis_json(axis));
  for (const PlannerChoice& planner : sweep.planners) {
    nlohmann::json choice = spec_to_json(planner);
    forget_plugin_files(choice);
    // Reports say of whom it was not only its sensors that it flew by.
    if ((needs_of(planner) & AB_INPUT_TRACKS) != 0) choice["sees_tracks"] = true;
    planners.push_back(choice);
  }
  nlohmann::json resolved{{"name", sweep.name},
                          {"base", base_json(sweep, trials)},
                          {"axes", axes},
                          {"trials", sweep.trials},
                          {"planners", planners}};
  if (!sweep.missions.empty()) {
    resolved["missions"] = missions_json(sweep.missions);
    resolved["trial_count"] = trials.size();  // maps may have unlike numbers of missions
  }
  if (sweep.limit.is_set()) resolved["limit"] = to_json(sweep.limit);
  if (sweep.until.is_set()) resolved["until"] = sweep.until.text();
  return resolved.dump();
}

PlannerRow planner_row(const PlannerChoice& choice) {
  PlannerRow row;
  row.label = choice.label;
  row.file_digest = flown_digest(choice);
  nlohmann::json parameters = nlohmann::json::object();
  for (const PluginChoice* plugin : plugins_of(choice)) {
    const bool is_filter = plugin != &choice;
    // It is asked again, and may have been replaced meanwhile.
    const PlannerDescription planner = describe_planner(plugin->source());
    if (planner.file_digest != plugin->file_digest) {
      throw InputError({.file = plugin->file, .message = "changed since the sweep was read"});
    }
    for (const ParameterChoice& parameter : plugin->parameters) {
      nlohmann::json& value = parameters[(is_filter ? "filter." : "") + parameter.name];
      if (parameter.is_text) {
        value = parameter.text;
      } else {
        value = parameter.number;
      }
    }
    row.name += (is_filter ? " + " : "") + planner.name;
    row.version += (is_filter ? " + " : "") + planner.version;
    row.is_privileged = row.is_privileged || (planner.needs & AB_INPUT_WORLD) != 0;
  }
  row.parameters_json = parameters.dump();
  return row;
}

}  // namespace avoidbench
