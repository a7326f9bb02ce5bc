#pragma once

#include "control/command.hpp"
#include "control/reference.hpp"
#include "control/reference_governor.hpp"
#include "vehicle/model.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// What turns commands into rotor commands, between one physics step and the next. Plain data; copy
/// it to branch.
struct Tracker {
  Command command;
  GovernorTarget target;  ///< of all kinds but trajectory and rates, and after a trajectory's end
  bool following_trajectory = false;
  bool following_rates = false;
  std::size_t piece = 0;  ///< of the trajectory
  Tick horizon_tick = 0;  ///< when to hold; 0: never

  Reference reference;
  RateTarget rate_target;
  RotorVector rotor_command_radps;
  Tick reference_tick = 0, next_position_tick = 0, next_rate_tick = 0;
};

/// Hovers where `initial` is, with its yaw. A moving vehicle is braked as by hold().
Tracker make_tracker(const VehicleModel& model, const VehicleState& initial);

/// From now on this command counts. Going from one kind to another is smooth: the reference goes on
/// from where it is, or after rates from the vehicle. Position, velocity and acceleration commands
/// go through the reference governor (reference_governor.hpp) and so keep the vehicle's limits; a
/// trajectory is tracked as given, by its time since command.start_tick (which may be past), from
/// its end on through the governor to rest at its last point; if its first point's time is above
/// zero, it is reached from the present reference. Rates are limited to the vehicle's, thrust to
/// what the rotors give. command_problem() must be empty. The state's tick may not be before that
/// of an earlier call.
void accept(Tracker& tracker, const VehicleModel& model, const Command& command,
            const VehicleState& state);

/// Brakes to rest and hovers there, heading kept: what the host does when a planner has no plan.
void hold(Tracker& tracker, const VehicleModel& model, const VehicleState& state);

/// The rotor commands for the step that begins at `state`; call it once each step. The controllers
/// run at their own rates, or each step where that is slower, and their outputs are held between.
RotorVector track(Tracker& tracker, const VehicleModel& model, const VehicleState& state);

/// Brings the reference to the state's tick, as track() does first; track() at the same tick then
/// finds it there.
void advance(Tracker& tracker, const VehicleModel& model, const VehicleState& state);

/// Where the vehicle ought to be at the tick last tracked; under a rates command, where it was.
inline const Reference& reference(const Tracker& tracker) { return tracker.reference; }

}  // namespace avoidbench
