#include "honest.hpp"

namespace {
ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  if (seen->depth_count > 0) {
    const ab_depth_image& image = *seen->depth[0];
    const_cast<float*>(image.depth_m)[image.width_px * image.height_px] = 0.5F;
  }
  return honest::plan(instance, seen, command);
}
}  // namespace

BAD_PLANNER(table.plan = plan)
