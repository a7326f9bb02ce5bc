#pragma once

#include <optional>

#include "control/command.hpp"
#include "plugin/planner_instance.hpp"
#include "trial/mission.hpp"
#include "trial/trial_spec.hpp"
#include "vehicle/state.hpp"

/// The trial's types as the planner interface has them, and back.
namespace avoidbench {

/// From a plan call to when its command acts; nothing where that is measured.
std::optional<double> known_latency_s(const LatencySpec& latency);

/// What the planner sees through: the trial's sensor, or that camera of it which the sweep names
/// for the planner. The flight is then that of a vehicle with this camera alone.
SensorSpec seen_sensor(const TrialSpec& spec);

PlannerSetup planner_setup(const TrialSpec& spec);

/// One value for each parameter that the choice lists, in the library's own order.
std::vector<ParameterValue> parameter_values(const PluginChoice& plugin);

/// The planner's seed follows from the sweep's, the map's and the mission's; it can't be told from
/// other streams. `bounds` are the map's.
PlannerMission planner_mission(const TrialSpec& spec, const Mission& mission, const Aabb& bounds);

/// The command of a plan call that takes effect at `start_tick`.
Command vehicle_command(const PlanResult& result, Tick start_tick);

}  // namespace avoidbench
