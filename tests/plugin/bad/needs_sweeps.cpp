#include "honest.hpp"

// It counts on a sweep in each call.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  if (seen->cloud_count > 0) return honest::plan(instance, seen, command);
  const ab_host& host = *static_cast<honest::Instance*>(instance)->host;
  host.set_error(host.context, "there is no sweep");
  return AB_ERROR;
}

}  // namespace

BAD_PLANNER(table.needs |= AB_INPUT_POINTS; table.plan = plan)
