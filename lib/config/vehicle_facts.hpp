#pragma once

#include "config/explain.hpp"

namespace avoidbench {

/// What the vehicles that are built in can do, in closed form (vehicle/capability.hpp): a table
/// with a row for each.
Explanation built_in_vehicles();

}  // namespace avoidbench
