#include "honest_filter.hpp"

// A filter that takes for granted that the planner below has a plan.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::pass_on(instance, seen, command);
  if (status != AB_OK)
    static_cast<honest::Instance*>(instance)->host->set_error(
        static_cast<honest::Instance*>(instance)->host->context, "no command to pass on");
  return status == AB_OK ? AB_OK : AB_ERROR;
}

}  // namespace

HONEST_FILTER(table.plan = plan)
