#include "honest.hpp"

// It moves tracks on to the call's time where they lie.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  for (std::uint32_t i = 0; i < seen->track_count; ++i) {
    const_cast<ab_track&>(seen->tracks[i]).center_world_m[0] += 0.1;
  }
  return honest::plan(instance, seen, command);
}

}  // namespace

BAD_PLANNER(table.needs |= AB_INPUT_TRACKS; table.plan = plan)
