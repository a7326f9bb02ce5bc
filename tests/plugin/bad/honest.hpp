#pragma once

#include <cmath>
#include <cstdint>

#include "avoidbench/planner.h"

/// A planner that keeps every rule; each file beside this one breaks one of them.
namespace honest {

struct Instance {
  const ab_host* host;
  double goal_x_m;
};

inline void* create(const ab_host* host, const ab_setup*) { return new Instance{host, 0.0}; }
inline void destroy(void* instance) { delete static_cast<Instance*>(instance); }
inline ab_status reset(void* instance, const ab_mission* mission) {
  static_cast<Instance*>(instance)->goal_x_m = mission->goal_world_m[0];
  return AB_OK;
}
inline ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const double ahead_m =
      static_cast<Instance*>(instance)->goal_x_m - seen->state->position_world_m[0];
  command->kind = AB_COMMAND_VELOCITY;
  command->velocity_world_mps[0] = std::isfinite(ahead_m) ? (ahead_m > 1.0 ? 1.0 : 0.0) : 0.0;
  return AB_OK;
}

inline ab_planner table() {
  ab_planner table{};
  table.struct_size = static_cast<std::uint32_t>(sizeof(ab_planner));
  table.abi_version = AVOIDBENCH_ABI_VERSION;
  table.name = "honest";
  table.version = "1";
  table.summary = "Flies along x.";
  table.needs = AB_INPUT_STATE | AB_INPUT_DEPTH;
  table.commands = AB_COMMAND_VELOCITY;
  table.create = create;
  table.destroy = destroy;
  table.reset = reset;
  table.plan = plan;
  return table;
}

}  // namespace honest

/// Exports honest::table() after `change` was made to it.
#define BAD_PLANNER(change)                                                              \
  extern "C" AB_EXPORT const ab_planner* avoidbench_planner_v1(std::uint32_t host_api) { \
    static const ab_planner made = [] {                                                  \
      ab_planner table = honest::table();                                                \
      change;                                                                            \
      return table;                                                                      \
    }();                                                                                 \
    return host_api == AVOIDBENCH_ABI_VERSION ? &made : nullptr;                         \
  }
