#pragma once

#include "plugin/pilot.hpp"
#include "trial/flight_change.hpp"
#include "trial/mission.hpp"
#include "trial/trial_observer.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// Flies one trial: `pilot`, reset first, takes the vehicle of `spec` from start to goal through
/// `scene`. A pure function of its arguments except for the measured times in `plan_calls`.
/// Everything that can go wrong in flight is an Outcome, never an exception; where the map has no
/// place for the trial's movers it throws InputError before. One thread; the scene, which is the
/// map's, may be shared with other trials. `observer` sees each call of the planner.
///
/// Measured latency: a call that took w of wall time acts w × scale later, rounded to the tick, and
/// until then the planner is busy: it is not called. `recorded_latency_s` (one a call, those of an
/// earlier flight) stand for the measured ones, and the flight is that one again; calls beyond
/// their end act at once. The mode `replay` needs them, `zero` and `fixed` do not look at them.
/// `change`: what is otherwise than the spec says.
TrialRecord run_trial(const TrialSpec& spec, const Scene& scene, const Mission& mission,
                      const Pilot& pilot, const TrialObserver& observer = {},
                      const std::vector<double>* recorded_latency_s = nullptr,
                      const FlightChange& change = {});

}  // namespace avoidbench
