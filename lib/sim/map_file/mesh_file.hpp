#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "map_file/map_file.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// The triangles of one node of a mesh file, in the file's units and axes, transforms applied.
struct MeshPart {
  std::string kind;  ///< of its obstacle, from the node's or the mesh's name: see obstacle_kind()
  FilePoints vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Material> materials;  ///< one a triangle
};

/// The kind of obstacle that a name in a file stands for: lower-case, without its number
/// ("Pillar.003" is "pillar"); floor and terrain are "ground", roof is "ceiling", and no name is
/// "mesh".
std::string obstacle_kind(std::string_view name);

/// The parts of an OBJ, PLY, STL, GLB or glTF file (by the extension of `file`), in the order of
/// the file's nodes; polygons are cut to triangles, points and lines left out. A surface whose
/// material is named as one of ours has that, others have `fallback`. Other files that this one
/// names are not read, so that its bytes say everything. Throws InputError, with the line or the
/// byte where there is one, where the file is damaged, has a vertex that is not finite, a polygon
/// whose edges cross, no triangle or more than `most_triangles`.
std::vector<MeshPart> parse_mesh(std::string_view bytes, const std::string& file, Material fallback,
                                 std::uint64_t most_triangles);

}  // namespace avoidbench
