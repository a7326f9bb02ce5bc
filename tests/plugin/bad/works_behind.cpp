#include <atomic>
#include <chrono>
#include <thread>

#include "honest.hpp"

// Its map is made by a thread beside the calls, which take what is ready: nothing as fast as it is
// called here, all where there is time between calls. It asks no clock.

namespace {

struct Instance : honest::Instance {
  std::atomic<int> wanted = 0, made = 0;
  std::jthread worker;  // last: it uses the others
};

void work(const std::stop_token& stop, std::atomic<int>& wanted, std::atomic<int>& made) {
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(8));
    made = wanted.load();
  }
}

void* create(const ab_host* host, const ab_setup*) {
  auto* const instance = new Instance{{host, 0.0}, 0, 0, {}};
  instance->worker = std::jthread(work, std::ref(instance->wanted), std::ref(instance->made));
  return instance;
}

void destroy(void* instance) { delete static_cast<Instance*>(instance); }

ab_status plan(void* given, const ab_observation* seen, ab_command* command) {
  auto* const instance = static_cast<Instance*>(given);
  const ab_status status = honest::plan(instance, seen, command);
  if (instance->made != instance->wanted) command->velocity_world_mps[0] = 0.0;
  ++instance->wanted;
  return status;
}

}  // namespace

BAD_PLANNER(table.create = create; table.destroy = destroy; table.plan = plan)
