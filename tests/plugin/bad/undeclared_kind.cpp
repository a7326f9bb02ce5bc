#include "honest.hpp"

namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(instance, seen, command);
  command->kind = AB_COMMAND_POSITION;
  return status;
}
}  // namespace

BAD_PLANNER(table.plan = plan)
