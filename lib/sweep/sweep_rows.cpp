#include "sweep/sweep_rows.hpp"

#include <filesystem>

#include "base/digest.hpp"
#include "base/spec_json.hpp"
#include "plugin/planner_library.hpp"

namespace avoidbench {
namespace {

nlohmann::json axis_json(const Axis& axis) {
  nlohmann::json values = axis.values;
  if (axis.path == "map.file" || axis.path == "wind.field.file") {
    for (nlohmann::json& value : values) {
      const std::string file = value.get<std::string>();
      value = {{"file", file}, {"file_digest", file.empty() ? "" : file_digest(file)}};
      forget_folder(value);
    }
  }
  return {{"path", axis.path}, {"values", values}};
}

}  // namespace

void forget_folder(nlohmann::json& block) {
  if (!block.contains("file")) return;
  block["file"] = std::filesystem::path(block["file"].get<std::string>()).filename().string();
}

void forget_folders(nlohmann::json& trial) {
  forget_folder(trial["map"]);
  forget_folder(trial["wind"]["field"]);
}

std::string sweep_json(const SweepSpec& sweep) {
  nlohmann::json axes = nlohmann::json::array(), planners = nlohmann::json::array();
  for (const Axis& axis : sweep.axes) axes.push_back(axis_json(axis));
  for (const PlannerChoice& planner : sweep.planners) {
    nlohmann::json choice = spec_to_json(planner);
    choice.erase("file");
    planners.push_back(choice);
  }
  nlohmann::json base = spec_to_json(sweep.base);
  base.erase("planner");
  forget_folders(base);
  nlohmann::json resolved{{"name", sweep.name},
                          {"base", base},
                          {"axes", axes},
                          {"trials", sweep.trials},
                          {"planners", planners}};
  if (sweep.until.is_set()) resolved["until"] = sweep.until.text();
  return resolved.dump();
}

PlannerRow planner_row(const PlannerChoice& choice) {
  const PlannerDescription planner = PlannerLibrary::load(choice.file).description();
  nlohmann::json parameters = nlohmann::json::object();
  for (const ParameterChoice& parameter : choice.parameters) {
    if (parameter.is_text) {
      parameters[parameter.name] = parameter.text;
    } else {
      parameters[parameter.name] = parameter.number;
    }
  }
  return {.label = choice.label,
          .name = planner.name,
          .version = planner.version,
          .file_digest = choice.file_digest,
          .parameters_json = parameters.dump(),
          .is_privileged = (planner.needs & AB_SEES_WORLD) != 0};
}

}  // namespace avoidbench
