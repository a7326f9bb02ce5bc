#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plugin/planner_instance.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// One call of the planner as it happened. References are valid while the observer is called.
struct PlanStep {
  double time_s = 0.0;    ///< of what it saw
  double effect_s = 0.0;  ///< when its command takes effect
  const VehicleState& truth;
  const VehicleState& believed;  ///< what the vehicle's own controller takes for its state
  const PlannerView& view;       ///< what it was shown
  const PlanResult& result;
  std::vector<Drawing> drawings;  ///< since the last call; of PlannerInstance::want_drawings
  std::vector<std::string> log;   ///< lines since the last call
};

/// Looks on while a trial is flown. Cannot change it.
struct TrialObserver {
  std::function<void(const PlanStep&)> planned;  ///< where set: after each call of the planner
};

}  // namespace avoidbench
