#include "honest.hpp"

extern "C" AB_EXPORT const ab_planner* avoidbench_planner_v1(std::uint32_t) { return nullptr; }
