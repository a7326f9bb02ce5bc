#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "control/tracking.hpp"
#include "plugin/planner_instance.hpp"
#include "trial/collision_check.hpp"
#include "trial/flight_change.hpp"
#include "trial/mission.hpp"
#include "trial/perception.hpp"
#include "trial/trial_record.hpp"
#include "vehicle/dynamics.hpp"
#include "wind/wind.hpp"

namespace avoidbench {

/// A command, or the lack of one, on its way from the planner to the vehicle.
struct PendingCommand {
  Tick due = 0;
  std::optional<Command> command;  ///< nothing: brake and hover
};

/// A trial that its caller steps: everything that changes while it is flown. begin_flight(), then
/// next_plan() and answer() in turn until nothing is asked any more, then end_flight():
///
///   Flight flight = begin_flight(spec, scene, mission, AB_INPUT_DEPTH);
///   while (const PlannerView* view = next_plan(flight)) answer(flight, my_plan(*view));
///   const TrialRecord record = end_flight(std::move(flight));
///
/// The same answers give the same flight to the last bit, whoever steps it. What begin_flight() was
/// given must outlive it. One thread at a time; flights may share a scene.
/// Members are for reading; only the functions below change them.
/// Invariants: state.tick is now and only one place moves it; `pending` is in the order of its due
/// ticks, since latencies never overtake (fixed, or the planner was busy); what is due at a tick is
/// done in the order of next_plan()'s loop.
struct Flight {
  const TrialSpec* spec = nullptr;
  const Scene* scene = nullptr;
  const Mission* mission = nullptr;
  const std::vector<double>* recorded_latency_s = nullptr;
  FlightChange change;
  std::unique_ptr<World> own_world;  ///< the map with the trial's movers, where it has any
  std::unique_ptr<Scene> moving;     ///< the scene with a time of its own, where things move in it
  double obstacle_speed_mps = 0.0;   ///< of the fastest

  VehicleModel model;
  Wind wind;
  Environment environment;  ///< of the step that begins now
  VehicleState state;       ///< the truth
  Tracker tracker;
  CollisionCheck collision_check;
  Perception perception;
  Tick physics_period = 0, plan_period = 0, sample_period = 0;
  Tick jerk_period = 0;  ///< of samples for jerks; sample_period where those have them
  Tick busy_until = 0;   ///< the planner, where latency is measured

  std::deque<PendingCommand> pending;  ///< by due tick
  bool sees_reference = false;         ///< the planner, AB_INPUT_REFERENCE
  bool sees_goals = false;             ///< the planner, AB_INPUT_GOALS
  std::size_t goal_index = 0;          ///< of the goal to reach now; after the end that of the last
  bool has_reached = false;            ///< a goal at this tick, which is not the last
  bool sees_tracks = false;            ///< the planner, AB_INPUT_TRACKS
  std::vector<TrackedThing> tracked;   ///< what moves, where it does
  bool was_touching = false;
  bool is_begun = false;           ///< whether the start was looked at
  bool is_asked = false;           ///< whether a plan was asked for at this tick
  bool is_answered = false;        ///< and given
  PlannerView view;                ///< what next_plan() shows
  std::optional<Outcome> stopped;  ///< set when the planner ends the trial
  std::optional<Outcome> outcome;  ///< set when the trial has ended
  TrialRecord record;              ///< of the flight so far
};

/// At the start. `scene` is the map's; movers are the flight's own. `needs` says what is sensed
/// (AB_INPUT_…). `recorded_latency_s`: see run_trial().
Flight begin_flight(const TrialSpec& spec, const Scene& scene, const Mission& mission,
                    std::uint32_t needs, const std::vector<double>* recorded_latency_s = nullptr,
                    const FlightChange& change = {});

/// Flies on until a plan is due: what the planner sees then, valid until the next call. Null: the
/// trial has ended, and `outcome` says how. What was asked before must be answered, or stopped.
const PlannerView* next_plan(Flight& flight);

/// The planner's answer to what next_plan() showed; its wall time is the latency where that is
/// measured. When its command takes effect.
Tick answer(Flight& flight, const PlanResult& result);

/// Ends the flight here, for a reason that is the planner's: next_plan() returns null from now on.
void stop_flight(Flight& flight, Outcome outcome, std::string reason);

/// All that is known of a flight that has ended.
TrialRecord end_flight(Flight&& flight);

/// Where the goal to reach now is.
Eigen::Vector3d goal_now_world(const Flight& flight);

/// What the vehicle's own controller takes for its state.
inline VehicleState believed_state(const Flight& flight) {
  return believed_state(flight.perception, flight.state);
}

}  // namespace avoidbench
