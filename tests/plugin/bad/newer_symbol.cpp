#include "honest.hpp"

// A planner of the next ABI alone.
extern "C" AB_EXPORT const ab_planner* avoidbench_planner_v2(std::uint32_t);
extern "C" AB_EXPORT const ab_planner* avoidbench_planner_v2(std::uint32_t) { return nullptr; }
