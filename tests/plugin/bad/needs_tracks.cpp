#include "honest.hpp"

// Its speed follows from how near the nearest thing is that moves: infinite where nothing does.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(instance, seen, command);
  double nearest_m = HUGE_VAL;
  for (std::uint32_t i = 0; i < seen->track_count; ++i) {
    const double ahead_m = seen->tracks[i].center_world_m[0] - seen->state->position_world_m[0];
    nearest_m = std::fmin(nearest_m, std::fabs(ahead_m));
  }
  command->velocity_world_mps[0] = 0.2 * nearest_m;
  return status;
}

}  // namespace

BAD_PLANNER(table.needs |= AB_INPUT_TRACKS; table.plan = plan)
