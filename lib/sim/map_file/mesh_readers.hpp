#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "map_file/map_file.hpp"
#include "map_file/mesh_file.hpp"

/// The reader of each kind of mesh file, behind parse_mesh(). They trust nothing: sizes, counts,
/// indices and references are checked before they are used, and numbers are finite. Textures,
/// normals, colours, animations and comments are left out. Each throws InputError with the file
/// and, in text, the line.
namespace avoidbench {

struct MeshSource {
  std::string_view bytes;
  const std::string& file;  ///< its name, for messages
  Material fallback;        ///< of surfaces whose material is none of ours
  std::uint64_t most_triangles;
};

std::vector<MeshPart> parse_obj(const MeshSource& source);
std::vector<MeshPart> parse_stl(const MeshSource& source);
std::vector<MeshPart> parse_ply_mesh(const MeshSource& source);
std::vector<MeshPart> parse_gltf(const MeshSource& source);

/// Most corners of a polygon: cutting it takes the square of their number, at worst the cube.
inline constexpr std::uint64_t kMostCorners = 1000;

/// Positions are kept in single precision, as world meshes are; near this point, so that those in
/// map coordinates (UTM) keep their decimals. The part of an offset along each axis: 0 near the
/// origin.
Eigen::Vector3d offset_near(const Eigen::Vector3d& vertex);

/// The next three words as numbers that single precision has.
Eigen::Vector3d take_position(std::string_view& words, const std::string& file, int line);

/// Our material of this name; else the fallback.
Material material_named(std::string_view name, Material fallback);

[[noreturn]] void fail_corners(const std::string& file, int line);
/// For faces that cut_polygon() can't cut.
[[noreturn]] void fail_crossing(const std::string& file, const std::string& face, int line);
[[noreturn]] void fail_triangles(const MeshSource& source);
[[noreturn]] void fail_vertices(const MeshSource& source);

}  // namespace avoidbench
