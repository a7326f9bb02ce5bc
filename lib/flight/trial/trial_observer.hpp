#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugin/planner_instance.hpp"
#include "trial/trial_record.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// What the planner knows of places now: PlannerInstance::look_up().
using PlaceLookUp = std::function<std::optional<std::vector<PlaceKnown>>(
    std::span<const Eigen::Vector3d> places_world)>;

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
  const PlaceLookUp& look_up;
};

/// A call of the planner that is about to be made. References as in PlanStep.
struct PlanCallAhead {
  double time_s = 0.0;
  const VehicleState& believed;
  const PlannerView& view;
  const TrialRecord& record;  ///< of the flight so far
};

/// Looks on while a trial is flown. Cannot change it, except that it may end it.
struct TrialObserver {
  /// Where set: before each call of the planner. False ends the flight here, as if the planner had
  /// given up.
  std::function<bool(const PlanCallAhead&)> planning;
  std::function<void(const PlanStep&)> planned;  ///< where set: after each call of the planner
};

}  // namespace avoidbench
