// Any bytes are a mesh or an InputError. The first byte chooses the kind of file.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/input_error.hpp"
#include "map_file/mesh_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 5> kFiles{"f.obj", "f.ply", "f.stl", "f.gltf", "f.glb"};
  constexpr std::uint64_t kMostTriangles = 100'000;
  if (size < 2) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    avoidbench::parse_mesh(bytes, kFiles[data[0] % kFiles.size()], avoidbench::Material::concrete,
                           kMostTriangles);
  } catch (const avoidbench::InputError&) {
  }
  return 0;
}
