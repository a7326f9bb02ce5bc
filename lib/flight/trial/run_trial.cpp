#include "trial/run_trial.hpp"

#include <utility>

#include "trial/flight.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

/// Tells the observer, where there is one.
void tell_planned(const Flight& flight, PlannerInstance& planner, const TrialObserver& observer,
                  const PlanResult& result, Tick due) {
  if (!observer.planned) return;
  const VehicleState believed = believed_state(flight);
  std::vector<Drawing> drawings = planner.take_drawings();  // may add to the log
  const PlaceLookUp look_up = [&planner](std::span<const Eigen::Vector3d> places_world) {
    return planner.look_up(places_world);
  };
  observer.planned({.time_s = seconds(flight.state.tick),
                    .effect_s = seconds(due),
                    .truth = flight.state,
                    .believed = believed,
                    .view = flight.view,
                    .result = result,
                    .drawings = std::move(drawings),
                    .log = planner.take_log(),
                    .look_up = look_up});
}

/// Asks the observer, where there is one.
bool may_call(const Flight& flight, const TrialObserver& observer) {
  if (!observer.planning) return true;
  const VehicleState believed = believed_state(flight);
  return observer.planning({.time_s = seconds(flight.state.tick),
                            .believed = believed,
                            .view = flight.view,
                            .record = flight.record});
}

}  // namespace

TrialRecord run_trial(const TrialSpec& spec, const Scene& scene, const Mission& mission,
                      PlannerInstance& planner, const TrialObserver& observer,
                      const std::vector<double>* recorded_latency_s, const FlightChange& change) {
  Flight flight = begin_flight(spec, scene, mission, planner.needs(), recorded_latency_s, change);
  planner.take_log();  // of an earlier trial
  planner.take_drawings();
  // A planner that can't begin has flown a trial that ends at once.
  if (std::string error = planner.reset(planner_mission(spec, mission, scene.world().bounds));
      !error.empty()) {
    stop_flight(flight, planner.has_crashed() ? Outcome::planner_crashed : Outcome::planner_error,
                "reset: " + error);
  }
  while (const PlannerView* view = next_plan(flight)) {
    if (!may_call(flight, observer)) {
      stop_flight(flight, Outcome::planner_gave_up, "");
      continue;
    }
    const PlanResult result = planner.plan(*view);
    const Tick due = answer(flight, result);
    tell_planned(flight, planner, observer, result, due);
  }
  return end_flight(std::move(flight));
}

}  // namespace avoidbench
