#include "trial/run_trial.hpp"

#include <utility>

#include "trial/flight.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

/// Tells the observer, where there is one.
void tell_planned(const Flight& flight, const Pilot& pilot, const TrialObserver& observer,
                  const PlanResult& result, Tick due) {
  if (!observer.planned) return;
  const VehicleState believed = believed_state(flight);
  std::vector<Drawing> drawings = take_drawings(pilot);  // may add to the log
  // What a filter knows of places is not asked: it holds no map of the way.
  const PlaceLookUp look_up = [&pilot](std::span<const Eigen::Vector3d> places_world) {
    return pilot.planner->look_up(places_world);
  };
  observer.planned({.time_s = seconds(flight.state.tick),
                    .effect_s = seconds(due),
                    .truth = flight.state,
                    .believed = believed,
                    .view = flight.view,
                    .result = result,
                    .drawings = std::move(drawings),
                    .log = take_log(pilot),
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
                      const Pilot& pilot, const TrialObserver& observer,
                      const std::vector<double>* recorded_latency_s, const FlightChange& change) {
  Flight flight = begin_flight(spec, scene, mission, needs(pilot), recorded_latency_s, change);
  take_log(pilot);  // of an earlier trial
  take_drawings(pilot);
  // A planner that can't begin has flown a trial that ends at once.
  if (std::string error = reset(pilot, planner_mission(spec, mission, scene.world().bounds));
      !error.empty()) {
    stop_flight(flight, has_crashed(pilot) ? Outcome::planner_crashed : Outcome::planner_error,
                "reset: " + error);
  }
  while (const PlannerView* view = next_plan(flight)) {
    if (!may_call(flight, observer)) {
      stop_flight(flight, Outcome::planner_gave_up, "");
      continue;
    }
    const PlanResult result = plan(pilot, *view);
    const Tick due = answer(flight, result);
    tell_planned(flight, pilot, observer, result, due);
  }
  return end_flight(std::move(flight));
}

}  // namespace avoidbench
