#include <array>

#include "base/poll.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/mesh_readers.hpp"

namespace avoidbench {
namespace {

/// 80 bytes of text and the count; a triangle is a normal and three corners in floats, and two
/// bytes.
constexpr std::size_t kHeader = 84, kTriangle = 50;

using Corners = std::array<Eigen::Vector3f, 3>;

/// The one part of an STL file, which has no names.
struct StlPart {
  const MeshSource& source;
  MeshPart part = {.kind = obstacle_kind(""), .vertices = {}, .triangles = {}, .materials = {}};

  void add(const Corners& corners) {
    poll_caller();
    if (part.triangles.size() >= source.most_triangles) fail_triangles(source);
    // STL knows no shared vertices: each triangle brings its three.
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    for (const Eigen::Vector3f& corner : corners) {
      part.vertices.push_back(corner.cast<double>() + Eigen::Vector3d::Zero());  // -0 becomes 0
    }
    part.triangles.push_back({first, first + 1, first + 2});
    part.materials.push_back(source.fallback);
  }
};

void add_binary(StlPart& part) {
  const std::string_view bytes = part.source.bytes;
  for (std::size_t at = kHeader; at + kTriangle <= bytes.size(); at += kTriangle) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      std::memcpy(corners[k].data(), &bytes[at + 12 + 12 * k], 12);  // after the normal
    }
    for (const Eigen::Vector3f& corner : corners) {
      if (corner.allFinite()) continue;
      fail_file(part.source.file, "triangle " + std::to_string((at - kHeader) / kTriangle + 1) +
                                      " at byte " + std::to_string(at) +
                                      ": a vertex is not finite");
    }
    part.add(corners);
  }
}

void add_ascii(StlPart& part) {
  const std::string& file = part.source.file;
  LineCursor lines{part.source.bytes};
  Corners corners;
  std::size_t corner = 0;
  bool is_open = false, has_ended = false;
  while (auto line = lines.next()) {
    // Words are taken one by one: loops and normals are passed over.
    const std::string_view key = take_word(*line);
    if (key == "vertex") {
      if (!is_open || corner >= 3) fail_file(file, "one vertex too many", lines.line);
      corners[corner++] = take_position(*line, file, lines.line).cast<float>();
    } else if (key == "facet") {
      if (is_open) fail_file(file, "the facet before does not end", lines.line);
      is_open = true;
      corner = 0;
    } else if (key == "endfacet") {
      if (!is_open || corner != 3) {
        fail_file(file, "a facet of " + std::to_string(corner) + " vertices", lines.line);
      }
      part.add(corners);
      is_open = false;
    } else if (key != "solid" && key != "endsolid" && key != "outer" && key != "endloop" &&
               !key.empty()) {
      fail_file(file, in_quotes(key) + " is not a word of an STL file", lines.line);
    }
    // A file of several solids ends with the last of them.
    if (!key.empty()) has_ended = key == "endsolid";
  }
  if (!has_ended) fail_file(file, "is truncated: it does not end with 'endsolid'", lines.line);
}

}  // namespace

std::vector<MeshPart> parse_stl(const MeshSource& source) {
  const std::string_view bytes = source.bytes;
  StlPart part{.source = source};
  std::uint64_t promised = 0;
  if (bytes.size() >= kHeader) promised = load<std::uint32_t>(bytes.data() + 80, false);
  std::string_view start = bytes.substr(0, 100);
  // The size decides first: headers of binary files may begin with "solid" too.
  if (bytes.size() == kHeader + kTriangle * promised) {
    add_binary(part);
  } else if (take_word(start) == "solid") {
    add_ascii(part);
  } else if (bytes.size() < kHeader) {
    fail_file(source.file, "is truncated: an STL file has 84 bytes at least");
  } else {
    fail_file(source.file, "is truncated or no STL: it promises " + std::to_string(promised) +
                               " triangles, " + std::to_string(kHeader + kTriangle * promised) +
                               " bytes, and has " + std::to_string(bytes.size()));
  }
  return {std::move(part.part)};
}

}  // namespace avoidbench
