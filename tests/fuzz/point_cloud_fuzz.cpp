// Any bytes are a point cloud or an InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/input_error.hpp"
#include "map_file/point_cloud_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    avoidbench::parse_point_cloud({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const avoidbench::InputError&) {
  }
  return 0;
}
