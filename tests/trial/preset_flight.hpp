#pragma once

#include <string>

#include "support/planner_files.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"

namespace avoidbench {

/// A trial of a planner with its default parameters.
inline TrialSpec spec_of(const std::string& planner) {
  TrialSpec spec;
  spec.planner = test::preset_choice(planner);
  return spec;
}

inline TrialRecord fly(const TrialSpec& spec, const World& world, const Mission& mission) {
  const Scene scene(world);
  const PlannerLibrary library = PlannerLibrary::load(spec.planner.file);
  PlannerInstance planner(library, planner_setup(spec), parameter_values(spec.planner));
  return run_trial(spec, scene, mission, planner);
}

}  // namespace avoidbench
