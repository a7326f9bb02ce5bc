#include "explain/explain.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "explain/collision_cause.hpp"
#include "explain/timeout_cause.hpp"

namespace avoidbench {
namespace {

/// How far outside the box; inside, less than 0.
double outside_m(const Aabb& box, const Eigen::Vector3d& place) {
  const double inside_m = std::min((place - box.min()).minCoeff(), (box.max() - place).minCoeff());
  return inside_m >= 0.0 ? -inside_m : box.exteriorDistance(place);
}

/// Of a flight that left the map.
CauseFound leaving_explained(const FailedFlight& flight) {
  CauseFound found;
  Facts& facts = found.facts;
  const Eigen::Vector3d commanded = flight.record.samples.back().reference_world;
  if (commanded.allFinite()) {
    facts.commanded_outside_m = outside_m(flight.world.bounds, commanded);
    facts.tracking_error_m = (flight.record.samples.back().position_world - commanded).norm();
  }
  found.cause = leaving_cause(facts);
  return found;
}

}  // namespace

bool needs_watch(const TrialRecord& record) {
  return record.outcome == Outcome::collided && !record.samples.empty();
}

CauseFound explained(const FailedFlight& flight, const StruckPatch* patch,
                     const FlightWatch* watch) {
  AB_CHECK(flight.record.outcome != Outcome::reached_goal);
  // A worker that died before the first sample leaves no path.
  const bool has_path = !flight.record.samples.empty();
  switch (flight.record.outcome) {
    case Outcome::collided:
      if (has_path && patch != nullptr) return collision_explained(flight, *patch, watch);
      break;
    case Outcome::timed_out:
      if (has_path) return timeout_explained(flight);
      break;
    case Outcome::left_bounds:
      if (has_path) return leaving_explained(flight);
      break;
    case Outcome::planner_gave_up:
      return {.cause = Cause::gave_up, .facts = {}};
    case Outcome::planner_error:
    case Outcome::planner_crashed:
    case Outcome::planner_hung:
      return {.cause = Cause::planner_failed, .facts = {}};
    case Outcome::reached_goal:
      break;
  }
  return {.cause = Cause::unexplained, .facts = {}};
}

}  // namespace avoidbench
