#include <string_view>

#include "honest.hpp"

// Flies another way once it was asked what it knows of places.
namespace {

bool was_asked = false;

ab_status look_up(void*, const double*, uint32_t point_count, uint8_t* places) {
  was_asked = true;
  for (uint32_t i = 0; i < point_count; ++i) places[i] = AB_PLACE_FREE;
  return AB_OK;
}

const void* get_extension(void* instance, const char* id) {
  static const ab_map map{sizeof(ab_map), 0, look_up};
  return instance != nullptr && std::string_view(id) == AB_MAP_EXTENSION ? &map : nullptr;
}

ab_status reset(void* instance, const ab_mission* mission) {
  was_asked = false;
  return honest::reset(instance, mission);
}

ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const ab_status status = honest::plan(instance, seen, command);
  if (was_asked) command->velocity_world_mps[1] = 0.1;
  return status;
}

}  // namespace

BAD_PLANNER((table.get_extension = get_extension, table.reset = reset, table.plan = plan))
