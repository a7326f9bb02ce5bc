#include "honest.hpp"

namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  volatile int turns = 0;
  while (turns >= 0) turns = turns > 1000 ? 0 : turns + 1;
  return honest::plan(instance, seen, command);
}
}  // namespace

BAD_PLANNER(table.plan = plan)
