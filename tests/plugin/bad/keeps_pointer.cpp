#include "honest.hpp"

// Keeps a pointer to the last image and reads it in the next call.
namespace {

struct Keeper {
  honest::Instance base;
  const float* last;
};

void* create(const ab_host* host, const ab_setup*) { return new Keeper{{host, 0.0}, nullptr}; }
void destroy(void* instance) { delete static_cast<Keeper*>(instance); }
ab_status reset(void* instance, const ab_mission* mission) {
  static_cast<Keeper*>(instance)->last = nullptr;
  return honest::reset(&static_cast<Keeper*>(instance)->base, mission);
}
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  Keeper& self = *static_cast<Keeper*>(instance);
  const ab_status status = honest::plan(&self.base, seen, command);
  if (self.last != nullptr) command->velocity_world_mps[1] = *self.last < 1.0F ? 0.1 : 0.0;
  self.last = seen->depth_count > 0 ? seen->depth[0]->depth_m : nullptr;
  return status;
}

}  // namespace

BAD_PLANNER(table.create = create; table.destroy = destroy; table.reset = reset; table.plan = plan)
