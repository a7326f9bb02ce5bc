#include <random>

#include "honest.hpp"

// Draws its seed from the machine, not from the mission.

namespace {

struct Instance : honest::Instance {
  std::mt19937 random{std::random_device()()};
};

void* create(const ab_host* host, const ab_setup*) { return new Instance{{host, 0.0}}; }

void destroy(void* instance) { delete static_cast<Instance*>(instance); }

ab_status plan(void* given, const ab_observation* seen, ab_command* command) {
  auto* const instance = static_cast<Instance*>(given);
  const ab_status status = honest::plan(instance, seen, command);
  command->velocity_world_mps[1] = 1e-9 * static_cast<double>(instance->random() % 1000);
  return status;
}

}  // namespace

BAD_PLANNER(table.create = create; table.destroy = destroy; table.plan = plan)
