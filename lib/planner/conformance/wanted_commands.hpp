#pragma once

#include <cstdint>

#include "conformance/conformance_flight.hpp"

namespace avoidbench {

/// The command of this kind (AB_COMMAND_…) that a planner which flies on along +x gives at the
/// frame.
PlanResult wanted_onward(const Frame& frame, std::uint32_t kind);

/// The answer of a planner that has no plan.
PlanResult no_plan();

/// What a filter sees at its call `index` where the frame says nothing: of the kinds that it
/// declares one after the other.
PlanResult wanted_in_turn(const Frame& frame, std::uint32_t kinds, std::size_t index);

}  // namespace avoidbench
