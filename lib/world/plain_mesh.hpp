#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

#include "world/map_file.hpp"

/// What a mesh file says, said again in the plainest file of its kind: assimp's readers trust what
/// they read, so they are given nothing else. Everything is checked before it is written: sizes,
/// counts, indices, references, finite numbers; textures, normals, animations and comments are left
/// out. Each throws InputError with the file and, in text, the line.
namespace avoidbench {

struct PlainMesh {
  std::string name;  ///< with the extension that chooses assimp's reader
  std::string bytes;
  /// To be added to positions: maps in map coordinates (UTM) would lose their decimals, since
  /// assimp has single precision.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// The part of an offset along each axis: 0 near the origin.
Eigen::Vector3d offset_near(const Eigen::Vector3d& vertex);

/// A name of at most 100 letters, digits, '.' and '_'.
std::string plain_name(std::string_view name);

/// Most corners of a polygon: cutting it takes the square of their number.
inline constexpr std::uint64_t kMostCorners = 1000;

[[noreturn]] void fail_corners(const std::string& file, int line);
[[noreturn]] void fail_triangles(const std::string& file, std::uint64_t most_triangles);
[[noreturn]] void fail_vertices(const std::string& file, std::uint64_t most_triangles);

PlainMesh plain_obj(std::string_view bytes, const std::string& file, std::uint64_t most_triangles);
PlainMesh plain_stl(std::string_view bytes, const std::string& file, std::uint64_t most_triangles);
PlainMesh plain_ply(std::string_view bytes, const std::string& file, std::uint64_t most_triangles);
/// A .gltf or .glb file, as .glb with triangle lists only.
PlainMesh plain_gltf(std::string_view bytes, const std::string& file, std::uint64_t most_triangles);

}  // namespace avoidbench
