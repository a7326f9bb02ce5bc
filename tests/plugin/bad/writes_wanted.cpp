#include "honest_filter.hpp"

// A filter that slows the wanted trajectory down where it lies.
namespace {

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  if (seen->wanted != nullptr) {
    for (std::uint32_t i = 0; i < seen->wanted->point_count; ++i) {
      const_cast<ab_point&>(seen->wanted->points[i]).velocity_world_mps[0] *= 0.5;
    }
  }
  return honest::pass_on(instance, seen, command);
}

}  // namespace

HONEST_FILTER(table.plan = plan)
