#include "honest.hpp"

// Needs a process for each trial, and ends it.
namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  volatile int* volatile nowhere = nullptr;
  *nowhere = 1;
  return honest::plan(instance, seen, command);
}
}  // namespace

BAD_PLANNER(table.needs |= AB_USES_GLOBALS; table.plan = plan)
