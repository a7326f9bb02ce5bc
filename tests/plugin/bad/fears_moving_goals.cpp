#include "honest.hpp"

// It flies to the goal that it is shown, and fails where the first one is not where it was.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const auto& self = *static_cast<honest::Instance*>(instance);
  if (seen->goal_index == 0 && seen->goal_world_m[0] != self.goal_x_m) {
    self.host->set_error(self.host->context, "the goal has moved");
    return AB_ERROR;
  }
  const ab_status status = honest::plan(instance, seen, command);
  command->velocity_world_mps[1] = seen->goal_world_m[1] > 0.0 ? 0.5 : -0.5;
  return status;
}

}  // namespace

BAD_PLANNER(table.needs |= AB_INPUT_GOALS; table.plan = plan)
