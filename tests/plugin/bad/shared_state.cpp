#include "honest.hpp"

namespace {
int call_count = 0;  // of all instances together

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(instance, seen, command);
  command->velocity_world_mps[1] = 0.001 * call_count++;
  return status;
}
}  // namespace

BAD_PLANNER(table.plan = plan)
