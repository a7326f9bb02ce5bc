#pragma once

#include "explain/explain.hpp"

namespace avoidbench {

/// Of a flight that ended with a contact.
CauseFound collision_explained(const FailedFlight& flight, const StruckPatch& patch,
                               const FlightWatch* watch);

/// Whether the vehicle left its commanded path; fills the facts that say so.
bool left_commanded_path(const FailedFlight& flight, Facts& facts);

}  // namespace avoidbench
