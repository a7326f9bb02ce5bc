#include <string_view>

#include "honest.hpp"

// Says of places what has no meaning.
namespace {

ab_status look_up(void*, const double*, uint32_t point_count, uint8_t* places) {
  for (uint32_t i = 0; i < point_count; ++i) places[i] = 9;
  return AB_OK;
}

const void* get_extension(void* instance, const char* id) {
  static const ab_map map{sizeof(ab_map), 0, look_up};
  return instance != nullptr && std::string_view(id) == AB_MAP_EXTENSION ? &map : nullptr;
}

}  // namespace

BAD_PLANNER(table.get_extension = get_extension)
