#pragma once

#include "explain/explain.hpp"

namespace avoidbench {

/// Of a flight that ended with a contact.
CauseFound collision_explained(const FailedFlight& flight, const StruckPatch& patch,
                               const FlightWatch* watch);

}  // namespace avoidbench
