#include "honest.hpp"

// Flies one trial in a process, as it says: what it counts in a global variable turns each later
// one.
#ifndef NEEDS_OF_ITS_OWN
#define NEEDS_OF_ITS_OWN AB_USES_GLOBALS
#endif

namespace {

int calls = 0;

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(static_cast<honest::Instance*>(instance), seen, command);
  command->velocity_world_mps[1] = 0.001 * calls++;
  return status;
}

}  // namespace

BAD_PLANNER(table.needs |= NEEDS_OF_ITS_OWN; table.plan = plan)
