#include "honest.hpp"

// Flies one trial in a process: what it counts in a global variable turns each later one.
namespace {

int calls = 0;

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(static_cast<honest::Instance*>(instance), seen, command);
  command->velocity_world_mps[1] = 0.001 * calls++;
  return status;
}

}  // namespace

BAD_PLANNER(table.plan = plan)
