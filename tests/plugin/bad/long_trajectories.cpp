#include "honest.hpp"

// Needs a process for each trial, and answers with the longest trajectories that are read.
namespace {

constexpr std::uint32_t kPoints = 10000;

ab_status plan(void*, const ab_observation* seen, ab_command* command) {
  static ab_point points[kPoints];
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    points[i].time_s = 1e-3 * i;
    points[i].position_world_m[0] = seen->state->position_world_m[0];
    points[i].position_world_m[2] = 2.0;
  }
  command->kind = AB_COMMAND_TRAJECTORY;
  command->points = points;
  command->point_count = kPoints;
  return AB_OK;
}

}  // namespace

BAD_PLANNER(table.needs |= AB_USES_GLOBALS; table.commands = AB_COMMAND_TRAJECTORY;
            table.plan = plan)
