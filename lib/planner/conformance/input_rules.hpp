#pragma once

#include <string>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// Why a planner that declares AB_INPUT_POINTS fails, or breaks the interface, with sweeps that
/// come seldom, several at once, empty or strange; "" where it does not, or declares nothing of the
/// kind.
std::string survives_odd_sweeps(const PlannerLibrary& library);

/// The same of one that declares AB_INPUT_TRACKS, with no tracks, many, and odd ones.
std::string survives_odd_tracks(const PlannerLibrary& library);

/// The same of a filter (AB_INPUT_COMMAND) with commands of each kind that it takes, none, and odd
/// ones.
std::string survives_odd_commands(const PlannerLibrary& library);

}  // namespace avoidbench
