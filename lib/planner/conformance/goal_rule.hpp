#pragma once

#include <string>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// Why a planner that declares AB_INPUT_GOALS does not fly to the goals that it is shown; "" where
/// it does, or declares nothing of the kind.
std::string flies_to_the_next_goal(const PlannerLibrary& library);

}  // namespace avoidbench
