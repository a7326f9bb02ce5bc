#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "world/world.hpp"

namespace avoidbench {

/// Steps of a mesh's coordinates along each side of its box: 12 bits.
inline constexpr std::int64_t kMeshSteps = 4095;

/// Meshes of a page, each once: forests share their plants, halls the shape of their cylinders.
class MeshStore {
 public:
  /// The mesh within its box, whose corners are rounded to its steps; its index.
  std::size_t add(const Prototype& prototype);
  nlohmann::ordered_json json() const { return meshes_; }
  std::size_t size() const { return meshes_.size(); }
  const nlohmann::ordered_json& operator[](std::size_t i) const { return meshes_[i]; }
  /// Takes out all from this one on.
  void cut(std::size_t size);

 private:
  std::map<std::vector<std::byte>, std::size_t> index_of_;  ///< by what is packed
  nlohmann::ordered_json meshes_ = nlohmann::ordered_json::array();
};

/// Triangles, all instances counted, above which a map is not put into a page.
inline constexpr std::size_t kMostPageTriangles = 3'000'000;

/// A map for a page: instances of the store's meshes, what moves, bounds.
nlohmann::ordered_json world_json(const World& world, MeshStore& meshes);

}  // namespace avoidbench
