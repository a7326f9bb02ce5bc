#pragma once

#include "control/command.hpp"
#include "plugin/planner_instance.hpp"
#include "trial/mission.hpp"
#include "trial/trial_spec.hpp"
#include "vehicle/state.hpp"

/// The trial's types as the planner interface has them, and back.
namespace avoidbench {

PlannerSetup planner_setup(const TrialSpec& spec);

/// One value for each parameter that `spec.planner` lists, in the planner's own order.
std::vector<ParameterValue> parameter_values(const PlannerChoice& planner);

/// The planner's seed follows from the sweep's, the map's and the mission's; it can't be told from
/// other streams.
PlannerMission planner_mission(const TrialSpec& spec, const Mission& mission);

/// The command of a plan call that takes effect at `start_tick`.
Command vehicle_command(const PlanResult& result, Tick start_tick);

}  // namespace avoidbench
