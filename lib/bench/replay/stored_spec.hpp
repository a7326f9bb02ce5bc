#pragma once

#include <string>

#include "trial/trial_spec.hpp"

namespace avoidbench {

/// The spec of a stored trial's spec_json: the planner has no file, and files of maps and winds
/// have their mere names. Throws BadText (store/stored_text.hpp) unless each field is there with
/// its type and within its range, so that what makes a map or a flight of it gets only what a sweep
/// file could have asked for. Contradictions between fields that concern sensors are left to
/// config/.
TrialSpec stored_spec(const std::string& spec_json);

}  // namespace avoidbench
