#include <chrono>

#include "honest.hpp"

// A solver that converges in 500 steps, unless its 100 ms are over before: on an idle machine they
// never are.

namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(100);
  double speed_mps = 0.0;
  for (int step = 0; step < 500 && Clock::now() < end; ++step) speed_mps += 0.5 * (1.0 - speed_mps);
  const ab_status status = honest::plan(static_cast<honest::Instance*>(instance), seen, command);
  command->velocity_world_mps[0] *= speed_mps;
  return status;
}

}  // namespace

BAD_PLANNER(table.plan = plan)
