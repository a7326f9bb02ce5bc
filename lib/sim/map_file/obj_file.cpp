#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/poll.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/mesh_readers.hpp"
#include "map_file/polygon.hpp"

namespace avoidbench {
namespace {

/// The rest of a line without the blanks around it.
std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Reads OBJ line by line. Vertices are numbered over the whole file; a part has those that its
/// faces name. An object is a part, and so is a group of another name than the one before; faces
/// before the first of them are a part too.
struct ObjReader {
  const MeshSource& source;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> vertices = {};  ///< from the offset

  /// Where a vertex is among those of the part that named it last.
  struct Copy {
    std::size_t part = ~std::size_t{0};
    std::uint32_t index = 0;
  };
  std::vector<Copy> copies = {};  ///< one a vertex

  std::vector<MeshPart> parts = {};
  std::size_t part = 0;                                       ///< the current one
  std::map<std::string_view, std::size_t> part_of_name = {};  ///< the first of each name
  std::string_view group = {};
  Material material = source.fallback;
  std::uint64_t triangle_count = 0;
  /// What the lines o, g and usemtl since the last face name: heeded only where a face follows.
  std::array<std::optional<std::string_view>, 3> pending = {};
  std::vector<std::uint32_t> face = {};
  std::vector<Eigen::Vector3f> corners = {};
  std::vector<CornerTriple> cuts = {};

  void add_vertex(std::string_view words, int line) {
    const Eigen::Vector3d position = take_position(words, source.file, line);
    const std::string_view w = take_word(words);
    // "v x y z w"; "v x y z r g b" has three more words.
    const bool has_w = !w.empty() && take_word(words).empty();  // more words are a color
    if (has_w && number_in<double>(w) != 1.0) fail_file(source.file, "a vertex's w is not 1", line);
    // The first vertex stands for all: those of a map are near each other.
    if (vertices.empty()) offset = offset_near(position);
    if (vertices.size() >= 3 * source.most_triangles) fail_vertices(source);
    vertices.emplace_back((position - offset).cast<float>());
    copies.emplace_back();
  }

  void begin_part(std::string_view name) {
    part = parts.size();
    part_of_name.try_emplace(name, part);
    parts.emplace_back();
    parts.back().kind = obstacle_kind(name);
  }

  void heed_pending() {
    const auto [object, new_group, surface] = std::exchange(pending, {});
    if (object) {
      // An object that was named before goes on; a group of a name begins a new part each time.
      const auto known = part_of_name.find(*object);
      if (known == part_of_name.end()) {
        begin_part(*object);
      } else {
        part = known->second;
      }
    }
    if (new_group && *new_group != group) {
      begin_part(*new_group);
      group = *new_group;
    }
    if (surface) material = material_named(*surface, source.fallback);
    if (parts.empty()) begin_part("");
  }

  /// The vertex among those of the current part.
  std::uint32_t in_part(std::uint32_t vertex) {
    Copy& copy = copies[vertex];
    MeshPart& to = parts[part];
    if (copy.part != part) {
      // The first use in this part: it gets a copy there.
      copy = {part, static_cast<std::uint32_t>(to.vertices.size())};
      to.vertices.push_back(vertices[vertex].cast<double>() + offset);
    }
    return copy.index;
  }

  /// The vertex that a corner names: from 1 on, or from the last one back.
  std::uint32_t vertex_of(std::string_view corner, int line) const {
    const auto number = number_in<std::int64_t>(corner.substr(0, corner.find('/')));
    if (!number) fail_file(source.file, in_quotes(corner) + " is not a corner of a face", line);
    const auto count = static_cast<std::int64_t>(vertices.size());
    if (*number == 0 || *number > count || *number < -count) {
      fail_file(source.file,
                "the face names vertex " + std::to_string(*number) + "; up to here there are " +
                    std::to_string(count),
                line);
    }
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
  }

  void add_face(std::string_view words, int line) {
    face.clear();
    corners.clear();
    for (auto word = take_word(words); !word.empty(); word = take_word(words)) {
      face.push_back(vertex_of(word, line));
      corners.push_back(vertices[face.back()]);
    }
    if (face.size() > kMostCorners) fail_corners(source.file, line);
    if (face.size() < 3) fail_file(source.file, "a face of fewer than 3 corners", line);
    triangle_count += face.size() - 2;
    if (triangle_count > source.most_triangles) fail_triangles(source);
    if (!cut_polygon(corners, cuts)) fail_crossing(source.file, "the face", line);
    heed_pending();
    for (std::uint32_t& vertex : face) vertex = in_part(vertex);
    for (const auto& [a, b, c] : cuts) {
      parts[part].triangles.push_back({face[a], face[b], face[c]});
      parts[part].materials.push_back(material);
    }
  }

  void add_line(std::string_view words, int line) {
    const std::string_view key = take_word(words);
    if (key.empty() || key[0] == '#') return;
    if (words.ends_with('\\'))
      fail_file(source.file, "lines continued with \\ are not supported", line);
    if (key == "v") add_vertex(words, line);
    if (key == "f") add_face(words, line);
    constexpr std::array<std::string_view, 3> kNamed{"o", "g", "usemtl"};
    for (std::size_t i = 0; i < kNamed.size(); ++i) {
      if (key == kNamed[i]) pending[i] = trimmed(words);
    }
  }
};

}  // namespace

std::vector<MeshPart> parse_obj(const MeshSource& source) {
  ObjReader reader{.source = source};
  LineCursor lines{source.bytes};
  while (const auto line = lines.next()) {
    poll_caller();
    reader.add_line(*line, lines.line);
  }
  return std::move(reader.parts);
}

}  // namespace avoidbench
