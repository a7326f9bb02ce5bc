#include <array>

#include "base/poll.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/point_cloud_file.hpp"

// OctoMap's binary files: some lines of text, then the tree from its root down. A node is two bytes
// with two bits for each of its eight children, followed by those children that are nodes.
namespace avoidbench {
namespace {

constexpr std::string_view kBinary = "# Octomap OcTree binary file";
constexpr std::string_view kFull = "# Octomap OcTree file";
constexpr unsigned kDepth = 16;  // of every OctoMap tree: 2^16 voxels a side
constexpr std::int32_t kHalf = 1 << (kDepth - 1);

struct OctreeHeader {
  std::string id;
  std::uint64_t nodes = 0;  ///< the root, inner ones and leaves
  double resolution = 0.0;
};

OctreeHeader read_octree_header(LineCursor& lines, const std::string& file) {
  constexpr int kMostLines = 10'000;
  OctreeHeader header;
  std::optional<std::uint64_t> nodes;
  while (const auto line = lines.next()) {
    const std::vector<std::string_view> words = words_of(*line);
    // Binary data after a header without an end may look like lines for long.
    if (lines.line > kMostLines) break;
    if (words.empty() || words[0].starts_with('#')) continue;
    const std::string_view value = words.size() > 1 ? words[1] : "";
    if (words[0] == "id") {
      header.id = value;
    } else if (words[0] == "size") {
      nodes = number_in<std::uint64_t>(value);
      if (!nodes) fail_file(file, "expected 'size' and one whole number", lines.line);
    } else if (words[0] == "res") {
      header.resolution = number_in<double>(value).value_or(0.0);
      // All of the tree's coordinates are finite then.
      if (header.resolution > 0.0 && std::isfinite(header.resolution * kHalf)) continue;
      fail_file(file, "expected 'res' and the side of a voxel, above 0", lines.line);
    } else if (words[0] == "data") {
      if (!nodes) fail_file(file, "the header lacks size", lines.line);
      if (header.resolution == 0.0) fail_file(file, "the header lacks res", lines.line);
      // Those that are written as OcTree is; 1 is OcTree's name of old.
      constexpr std::array<std::string_view, 4> kIds{"OcTree", "ColorOcTree", "OcTreeStamped", "1"};
      if (std::find(kIds.begin(), kIds.end(), header.id) == kIds.end()) {
        fail_file(file, "is an octree with the id " + in_quotes(header.id) + ", not OcTree");
      }
      header.nodes = *nodes;
      return header;
    } else {
      fail_file(file, in_quotes(words[0]) + " is not a word of an OctoMap header", lines.line);
    }
  }
  fail_file(file, "the header does not end ('data')", lines.line);
}

using Key = std::array<std::int32_t, 3>;  ///< voxels from the tree's lowest corner

struct TreeReader {
  const OctreeHeader& header;
  std::string_view bytes;  ///< the whole file
  std::size_t at;
  const std::string& file;
  std::uint64_t nodes = 1;  ///< met so far; the root is one
  FilePoints points = {};

  /// An occupied leaf may stand for a cube of many voxels.
  void add_leaf(const Key& lowest, unsigned depth) {
    const std::uint64_t side = std::uint64_t{1} << (kDepth - depth);
    if (points.size() + side * side * side > kMostVoxels) {
      fail_file(file, "has more than " + std::to_string(kMostVoxels) +
                          " occupied voxels: make its voxels larger or cut out a part first");
    }
    const auto end = static_cast<std::int32_t>(side);
    const auto centre = [&](std::size_t axis, std::int32_t step) {
      return (static_cast<double>(lowest[axis] + step - kHalf) + 0.5) * header.resolution;
    };
    for (std::int32_t x = 0; x < end; ++x) {
      for (std::int32_t y = 0; y < end; ++y) {
        for (std::int32_t z = 0; z < end; ++z) {
          points.emplace_back(centre(0, x), centre(1, y), centre(2, z));
        }
      }
    }
  }

  /// The node's two bytes are next; `depth` is 0 for the root.
  void read_node(const Key& lowest, unsigned depth) {
    poll_caller();
    if (bytes.size() - at < 2) {
      fail_file(file, "is truncated: the header promises " + std::to_string(header.nodes) +
                          " nodes, there are " + std::to_string(nodes));
    }
    if (depth == kDepth) {
      fail_file(file, "byte " + std::to_string(at) + ": the tree is deeper than 16 levels");
    }
    const unsigned children = load<std::uint16_t>(bytes.data() + at, false);
    at += 2;
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned kind = (children >> (2 * i)) & 3U;
      if (kind == 0U) continue;  // unknown
      ++nodes;
      if (kind == 1U) continue;  // free
      // Bit by bit the child is in the upper half along x, y and z.
      Key child = lowest;
      for (unsigned axis = 0; axis < 3; ++axis) {
        if (((i >> axis) & 1U) != 0) child[axis] += kHalf >> depth;
      }
      if (kind == 2U) {
        add_leaf(child, depth + 1);
      } else {
        read_node(child, depth + 1);
      }
    }
  }
};

}  // namespace

bool is_octree(std::string_view bytes) { return bytes.starts_with(kBinary); }

bool is_full_octree(std::string_view bytes) { return bytes.starts_with(kFull); }

double octree_resolution(std::string_view bytes, const std::string& file) {
  LineCursor lines{bytes};
  return read_octree_header(lines, file).resolution;
}

FilePoints parse_octree_points(std::string_view bytes, const std::string& file) {
  LineCursor lines{bytes};
  const OctreeHeader header = read_octree_header(lines, file);
  if (header.nodes == 0) return {};
  TreeReader reader{
      .header = header, .bytes = bytes, .at = bytes.size() - lines.rest.size(), .file = file};
  reader.read_node({0, 0, 0}, 0);
  if (reader.nodes != header.nodes) {
    fail_file(file, "is damaged: the header promises " + std::to_string(header.nodes) +
                        " nodes, there are " + std::to_string(reader.nodes));
  }
  return std::move(reader.points);
}

}  // namespace avoidbench
