#pragma once

#include <string>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// Whether the planner still looks at its first camera where a second one looks down, whose images
/// come first. What was seen against it; "" where it does, and of planners that declare
/// AB_INPUT_ONE_CAMERA, see no images or give the same commands whatever one camera shows.
std::string tells_cameras_apart(const PlannerLibrary& library);

}  // namespace avoidbench
