#include "honest.hpp"

// Counts its calls and does not forget them in reset.
namespace {

struct Counter {
  honest::Instance base;
  int call_count;
};

void* create(const ab_host* host, const ab_setup*) { return new Counter{{host, 0.0}, 0}; }
void destroy(void* instance) { delete static_cast<Counter*>(instance); }
ab_status reset(void* instance, const ab_mission* mission) {
  return honest::reset(&static_cast<Counter*>(instance)->base, mission);
}
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  Counter& self = *static_cast<Counter*>(instance);
  const ab_status status = honest::plan(&self.base, seen, command);
  command->velocity_world_mps[1] = 0.001 * self.call_count++;
  return status;
}

}  // namespace

BAD_PLANNER(table.create = create; table.destroy = destroy; table.reset = reset; table.plan = plan)
