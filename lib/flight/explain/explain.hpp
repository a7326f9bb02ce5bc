#pragma once

#include <cstdint>
#include <optional>

#include "explain/causes.hpp"
#include "explain/flight_watch.hpp"
#include "explain/struck_patch.hpp"
#include "trial/mission.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// A failed flight, with all that its cause is told from.
struct FailedFlight {
  const TrialSpec& spec;  ///< with the places of its files
  const World& world;
  const Mission& mission;
  const TrialRecord& record;
  double reference_length_m;  ///< of the shortest path
  /// AB_… bits that the planner and its filter declare; none: they can't be loaded.
  std::optional<std::uint32_t> planner_needs = {};
};

/// Whether its cause can only be told from the flight flown again, watched by a FlightWatch.
bool needs_watch(const TrialRecord& record);

/// Why it failed, by the rules of docs/explain.md. `patch` is that of the flight; `watch` has seen
/// it flown again; null: it can't be, and what only a watch tells is unexplained.
/// The flight did not reach the goal.
CauseFound explained(const FailedFlight& flight, const StruckPatch* patch,
                     const FlightWatch* watch);

}  // namespace avoidbench
