#include "plugin/bad/honest.hpp"

extern "C" double solve(double target);

namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(static_cast<honest::Instance*>(instance), seen, command);
  command->velocity_world_mps[0] = solve(command->velocity_world_mps[0]);
  return status;
}

}  // namespace

BAD_PLANNER(table.plan = plan)
