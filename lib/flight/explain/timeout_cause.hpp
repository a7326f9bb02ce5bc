#pragma once

#include "explain/explain.hpp"

namespace avoidbench {

/// Of a flight that ran out of time.
CauseFound timeout_explained(const FailedFlight& flight);

}  // namespace avoidbench
