#include "honest.hpp"

namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  if (seen->depth_count > 0) const_cast<float*>(seen->depth[0]->depth_m)[5] = 0.5F;
  return honest::plan(instance, seen, command);
}
}  // namespace

BAD_PLANNER(table.plan = plan)
