#include "honest.hpp"

namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(instance, seen, command);
  command->velocity_world_mps[1] = std::nan("");
  return status;
}
}  // namespace

BAD_PLANNER(table.plan = plan)
