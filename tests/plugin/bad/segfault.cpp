#include "honest.hpp"

namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  volatile int* volatile nowhere = nullptr;
  *nowhere = 1;
  return honest::plan(instance, seen, command);
}
}  // namespace

BAD_PLANNER(table.plan = plan)
