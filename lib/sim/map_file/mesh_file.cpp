#include "map_file/mesh_file.hpp"

#include <cmath>

#include "base/enum_text.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/mesh_readers.hpp"

namespace avoidbench {

/// Lower-case words joined by _, without the numbers that editors put behind copies: "Tree.001" is
/// a tree.
std::string obstacle_kind(std::string_view name) {
  constexpr std::size_t kMost = 40;
  std::string kind;
  for (const char c : name.substr(0, kMost)) {
    const bool is_upper = c >= 'A' && c <= 'Z';
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_upper || is_plain) {
      kind += is_upper ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!kind.empty() && kind.back() != '_') {
      kind += '_';
    }
  }
  while (!kind.empty() && (kind.back() == '_' || (kind.back() >= '0' && kind.back() <= '9'))) {
    kind.pop_back();
  }
  // Names that exporters give where nobody gave one.
  if (kind.empty() || kind == "defaultobject" || kind == "nodes") return "mesh";
  if (kind == "floor" || kind == "terrain") return "ground";
  return kind == "roof" ? "ceiling" : kind;
}

Material material_named(std::string_view name, Material fallback) {
  return enum_from_text<Material>(obstacle_kind(name)).value_or(fallback);
}

Eigen::Vector3d offset_near(const Eigen::Vector3d& vertex) {
  // Up to here a float tells half a millimetre.
  constexpr double kNear = 4096.0, kLimit = 1e12;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double value = vertex[axis];
    // Whole metres: a double takes them off without rounding.
    if (std::abs(value) > kNear && std::abs(value) < kLimit) offset[axis] = std::floor(value);
  }
  return offset;
}

Eigen::Vector3d take_position(std::string_view& words, const std::string& file, int line) {
  Eigen::Vector3d position;
  for (double& value : position) {
    const std::string_view word = take_word(words);
    const auto number = number_in<double>(word);
    if (!number) {
      fail_file(file, word.empty() ? "too few numbers" : in_quotes(word) + " is not a number",
                line);
    }
    // As a float, in which it is kept: 1e300 would become infinite.
    if (!std::isfinite(static_cast<float>(*number))) {
      fail_file(file, "vertex: " + in_quotes(word) + " is not finite", line);
    }
    value = *number;
  }
  return position;
}

void fail_corners(const std::string& file, int line) {
  fail_file(file,
            "a face of more than " + std::to_string(kMostCorners) +
                " corners; cut it into triangles first",
            line);
}

void fail_crossing(const std::string& file, const std::string& face, int line) {
  fail_file(file, face + " has edges that cross; cut it into triangles first", line);
}

void fail_triangles(const MeshSource& source) {
  fail_file(source.file, "has more than " + std::to_string(source.most_triangles) +
                             " triangles; decimate it first");
}

void fail_vertices(const MeshSource& source) {
  fail_file(source.file, "has more than " + std::to_string(3 * source.most_triangles) +
                             " vertices, three for each of the most triangles; decimate it first");
}

std::vector<MeshPart> parse_mesh(std::string_view bytes, const std::string& file, Material fallback,
                                 std::uint64_t most_triangles) {
  const MeshSource source{bytes, file, fallback, most_triangles};
  const std::string extension = extension_of(file);
  std::vector<MeshPart> parts = extension == "obj"   ? parse_obj(source)
                                : extension == "ply" ? parse_ply_mesh(source)
                                : extension == "stl" ? parse_stl(source)
                                                     : parse_gltf(source);
  std::erase_if(parts, [](const MeshPart& part) { return part.triangles.empty(); });
  if (parts.empty()) fail_file(file, "has no triangles");
  return parts;
}

}  // namespace avoidbench
