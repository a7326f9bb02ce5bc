#include "honest.hpp"

namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  honest::plan(instance, seen, command);
  return 5;
}
}  // namespace

BAD_PLANNER(table.plan = plan)
