#include "honest.hpp"

extern "C" AB_EXPORT int avoidbench_secret();
extern "C" AB_EXPORT int avoidbench_secret() { return 1; }

BAD_PLANNER(static_cast<void>(table))
