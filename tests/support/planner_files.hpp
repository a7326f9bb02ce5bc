#pragma once

#include <filesystem>
#include <string>

#include "plugin/planner_library.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench::test {

/// The library of a planner of this build.
inline std::string built_planner(const std::string& name) {
  return std::filesystem::path(AVOIDBENCH_BINARY_DIR) / "planners" / (name + ".so");
}

/// The choice of a built planner with its presets.
inline PlannerChoice preset_choice(const std::string& name) {
  const PlannerDescription planner = PlannerLibrary::load(built_planner(name)).description();
  PlannerChoice choice;
  choice.plugin = choice.label = name;
  choice.file = planner.file.string();
  choice.file_digest = planner.file_digest;
  for (const ParameterDef& parameter : planner.parameters) {
    choice.parameters.push_back(
        {.name = parameter.name,
         .number = parameter.preset,
         .text = parameter.preset_text,
         .is_text = parameter.kind == AB_CHOICE || parameter.kind == AB_TEXT});
  }
  return choice;
}

}  // namespace avoidbench::test
