#include "honest.hpp"

// Of a rig it takes the newest image, from whichever camera that is.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(instance, seen, command);
  if (seen->depth_count == 0) return status;
  const ab_depth_image& image = *seen->depth[0];
  const float middle_m = image.depth_m[image.height_px / 2 * image.width_px + image.width_px / 2];
  if (middle_m < 4.0F) command->velocity_world_mps[0] = 0.0;
  return status;
}

}  // namespace

BAD_PLANNER(table.plan = plan)
