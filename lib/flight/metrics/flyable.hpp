#pragma once

#include <cstdint>
#include <string>

#include "trial/trial_spec.hpp"

namespace avoidbench {

/// How many of the first `mission_count` missions of the trial's map have a free start and goal.
/// Cheap beside measuring the map; there may still be no way between them. Throws InputError where
/// the map can't be made.
std::int64_t placed_missions(const TrialSpec& trial, std::int64_t mission_count);

/// Why none of these missions can be flown and what may help, for people: with another axis of the
/// file up some could be, the map's size is not what it should be, there is too little free space.
/// For a trial of which no mission can be flown; takes as long as measuring the map does.
std::string unflyable_hint(const TrialSpec& trial, std::int64_t mission_count);

}  // namespace avoidbench
