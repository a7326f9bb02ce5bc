#include "honest.hpp"

// Flies another way when somebody looks at its drawings.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_host* host = static_cast<honest::Instance*>(instance)->host;
  const ab_status status = honest::plan(instance, seen, command);
  const auto* debug =
      static_cast<const ab_debug*>(host->get_extension(host->context, AB_DEBUG_EXTENSION));
  if (debug != nullptr && debug->is_wanted(debug->context) != 0) {
    command->velocity_world_mps[1] = 0.1;
  }
  return status;
}

}  // namespace

BAD_PLANNER(table.plan = plan)
