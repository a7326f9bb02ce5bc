#include <cstring>

#include "honest.hpp"

// Depends on a file more than the host follows.
namespace {

const void* get_extension(void*, const char* id) {
  static const char* names[1001];
  for (const char*& name : names) name = "weights.bin";
  static const ab_files files{static_cast<std::uint32_t>(sizeof(ab_files)), 1001, names};
  return std::strcmp(id, AB_FILES_EXTENSION) == 0 ? &files : nullptr;
}

}  // namespace

BAD_PLANNER(table.get_extension = get_extension)
