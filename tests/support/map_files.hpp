#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "map_file/map_file.hpp"
#include "support/temporary_folder.hpp"

/// Map files to read, written by the test itself.
namespace avoidbench::test {

template <class T>
std::string raw(T value, bool is_big_endian = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return is_big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

inline std::string vertex_text(const Eigen::Vector3f& v) {
  std::ostringstream text;
  text << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

inline std::string obj_bytes(const TriangleMesh& mesh) {
  std::string text = "# a mesh\no Pillar.001\nusemtl brick\n";
  for (const auto& v : mesh.vertices) text += "v " + vertex_text(v) + "\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
            std::to_string(c + 1) + "\n";
  }
  return text;
}

inline std::string ply_mesh_header(const TriangleMesh& mesh, const std::string& format) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ascii_ply_bytes(const TriangleMesh& mesh) {
  std::string text = ply_mesh_header(mesh, "ascii");
  for (const auto& v : mesh.vertices) text += vertex_text(v) + "\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  }
  return text;
}

inline std::string binary_ply_bytes(const TriangleMesh& mesh, bool is_big_endian) {
  std::string bytes =
      ply_mesh_header(mesh, is_big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) bytes += raw(v[axis], is_big_endian);
  }
  for (const auto& triangle : mesh.triangles) {
    bytes += '\3';
    for (const std::uint32_t corner : triangle) bytes += raw(corner, is_big_endian);
  }
  return bytes;
}

inline std::string ascii_stl_bytes(const TriangleMesh& mesh) {
  std::string text = "solid pillar\n";
  for (const auto& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t corner : triangle) {
      text += "vertex " + vertex_text(mesh.vertices[corner]) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid pillar\n";
}

inline std::string binary_stl_bytes(const TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  bytes += raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    bytes += std::string(12, '\0');
    for (const std::uint32_t corner : triangle) {
      for (int axis = 0; axis < 3; ++axis) bytes += raw(mesh.vertices[corner][axis]);
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const char c = i + k < bytes.size() ? bytes[i + k] : '\0';
      group = (group << 8U) | static_cast<unsigned char>(c);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[(group >> (18U - 6U * k)) & 63U];
    }
  }
  return text;
}

/// A glTF scene with the mesh in one node; `node` is more of its JSON, as `,"translation":[…]`.
/// With is_glb the binary form.
inline std::string gltf_bytes(const TriangleMesh& mesh, bool is_glb, const std::string& node = "") {
  std::string buffer;
  for (const auto& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) buffer += raw(v[axis]);
  }
  const std::size_t vertices_size = buffer.size();
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) buffer += raw(corner);
  }
  const auto view = [](std::size_t offset, std::size_t size) {
    return "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
           ",\"byteLength\":" + std::to_string(size) + "}";
  };
  const std::string uri =
      is_glb ? "" : ",\"uri\":\"data:application/octet-stream;base64," + base64(buffer) + "\"";
  std::string json =
      "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
      "\"nodes\":[{\"name\":\"Pillar.001\",\"mesh\":0" +
      node +
      "}],\"materials\":[{\"name\":\"brick\"}],\"meshes\":[{\"primitives\":[{\"attributes\":"
      "{\"POSITION\":0},\"indices\":1,\"material\":0}]}],\"accessors\":["
      "{\"bufferView\":0,\"componentType\":5126,\"count\":" +
      std::to_string(mesh.vertices.size()) +
      ",\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5125,\"count\":" +
      std::to_string(3 * mesh.triangles.size()) + ",\"type\":\"SCALAR\"}],\"bufferViews\":[" +
      view(0, vertices_size) + "," + view(vertices_size, buffer.size() - vertices_size) +
      "],\"buffers\":[{\"byteLength\":" + std::to_string(buffer.size()) + uri + "}]}";
  if (!is_glb) return json;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto chunk = [](const std::string& bytes, const std::string& kind) {
    return raw(static_cast<std::uint32_t>(bytes.size())) + kind + bytes;
  };
  const std::string chunks = chunk(json, "JSON") + chunk(buffer, std::string("BIN\0", 4));
  return "glTF" + raw(std::uint32_t{2}) + raw(static_cast<std::uint32_t>(12 + chunks.size())) +
         chunks;
}

/// A name and the bytes of the same mesh in each format.
inline std::vector<std::pair<std::string, std::string>> all_meshes(const TriangleMesh& mesh) {
  return {{"a.obj", obj_bytes(mesh)},
          {"ascii.ply", ascii_ply_bytes(mesh)},
          {"little.ply", binary_ply_bytes(mesh, false)},
          {"big.ply", binary_ply_bytes(mesh, true)},
          {"ascii.stl", ascii_stl_bytes(mesh)},
          {"binary.STL", binary_stl_bytes(mesh)},
          {"a.glb", gltf_bytes(mesh, true)},
          {"a.gltf", gltf_bytes(mesh, false)}};
}

/// An LZF stream that copies nothing.
inline std::string lzf_literals(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 32) {
    const std::string piece = bytes.substr(i, 32);
    out += static_cast<char>(piece.size() - 1) + piece;
  }
  return out;
}

/// With a camera before the vertices, a list and a color between the coordinates.
inline std::string ply(const FilePoints& points, const std::string& format) {
  const bool is_big = format == "binary_big_endian";
  std::string bytes = "ply\r\nformat " + format +
                      " 1.0\r\ncomment made by a test\r\nelement camera 1\r\nproperty short id\r\n"
                      "element vertex " +
                      std::to_string(points.size()) +
                      "\r\nproperty float x\r\nproperty uchar red\r\nproperty double y\r\n"
                      "property float32 z\r\nproperty list uchar int seen_by\r\nend_header\r\n";
  const bool is_text = format == "ascii";
  bytes += is_text ? "7\r\n" : raw(std::int16_t{7}, is_big);
  for (const Eigen::Vector3d& p : points) {
    if (is_text) {
      std::ostringstream line;
      line.precision(12);
      line << p.x() << " 200 " << p.y() << " +" << p.z() << " 2 5 6\r\n";
      bytes += line.str();
      continue;
    }
    bytes += raw(static_cast<float>(p.x()), is_big) + '\xc8' + raw(p.y(), is_big) +
             raw(static_cast<float>(p.z()), is_big) + '\2' + raw(5, is_big) + raw(6, is_big);
  }
  return bytes;
}

/// With colours between the coordinates.
inline std::string pcd(const FilePoints& points, const std::string& data) {
  const std::string count = std::to_string(points.size());
  std::string bytes =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x rgb y z\nSIZE 4 2 8 4\nTYPE F U F F\nCOUNT 1 2 1 1\n"
      "WIDTH " +
      count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + data + "\n";
  std::string x, colors, y, z;
  for (const Eigen::Vector3d& p : points) {
    const std::string one_x = raw(static_cast<float>(p.x())), one_y = raw(p.y());
    const std::string one_z = raw(static_cast<float>(p.z())), color = raw(std::uint32_t{77});
    x += one_x, colors += color, y += one_y, z += one_z;
    if (data == "binary") bytes += one_x + color + one_y + one_z;
    if (data != "ascii") continue;
    std::ostringstream line;
    line.precision(12);
    line << p.x() << " 1 2 " << p.y() << '\t' << p.z() << '\n';
    bytes += line.str();
  }
  if (data != "binary_compressed") return bytes;
  const std::string columns = x + colors + y + z;
  const std::string packed = lzf_literals(columns);
  return bytes + raw(static_cast<std::uint32_t>(packed.size())) +
         raw(static_cast<std::uint32_t>(columns.size())) + packed;
}

/// How a LAS file says the same points.
struct LasForm {
  int minor = 2;            ///< of version 1
  int format = 0;           ///< of the points
  std::size_t extra = 0;    ///< bytes behind what the format has
  std::size_t records = 0;  ///< before the points, of 10 bytes each
  double scale = 1.0 / 64;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::vector<std::size_t> withheld = {};  ///< points that are flagged so
  bool has_legacy_count = true;
};

/// Puts a number's bytes over those at a place.
template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  bytes.replace(at, sizeof(T), raw(value));
}

inline std::string las(const FilePoints& points, const LasForm& form = {}) {
  constexpr std::array<std::size_t, 11> kSizes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  const std::size_t header_size = form.minor == 4 ? 375 : form.minor == 3 ? 235 : 227;
  const std::size_t size = kSizes.at(static_cast<std::size_t>(form.format)) + form.extra;
  const std::string record = std::string(2, '\0') + "avoidbench test " + raw(std::uint16_t{7}) +
                             raw(std::uint16_t{10}) + std::string(32 + 10, 'r');
  std::string bytes(header_size, '\0');
  bytes.replace(0, 4, "LASF");
  bytes[24] = 1;
  bytes[25] = static_cast<char>(form.minor);
  put(bytes, 94, static_cast<std::uint16_t>(header_size));
  put(bytes, 96, static_cast<std::uint32_t>(header_size + form.records * record.size()));
  put(bytes, 100, static_cast<std::uint32_t>(form.records));
  bytes[104] = static_cast<char>(form.format);
  put(bytes, 105, static_cast<std::uint16_t>(size));
  if (form.has_legacy_count) put(bytes, 107, static_cast<std::uint32_t>(points.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 131 + 8 * axis, form.scale);
    put(bytes, 155 + 8 * axis, form.offset[static_cast<Eigen::Index>(axis)]);
  }
  if (form.minor == 4) put(bytes, 247, static_cast<std::uint64_t>(points.size()));
  for (std::size_t i = 0; i < form.records; ++i) bytes += record;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d steps = (points[i] - form.offset) / form.scale;
    std::string point(size, '\x11');  // neither flag for being withheld
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = std::round(steps[static_cast<Eigen::Index>(axis)]);
      put(point, 4 * axis, static_cast<std::int32_t>(step));
    }
    if (std::count(form.withheld.begin(), form.withheld.end(), i) > 0) {
      point[15] = form.format < 6 ? '\x82' : '\x04';
    }
    bytes += point;
  }
  return bytes + "what may follow the points";
}

/// An OctoMap .bt file of a tree's bytes.
inline std::string octree(std::uint64_t nodes, const std::string& resolution,
                          const std::string& tree) {
  return "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first "
         "line as it is!)\n#\nid OcTree\nsize " +
         std::to_string(nodes) + "\nres " + resolution + "\ndata\n" + tree;
}

/// A node's two bytes: what its children are, from the first to the eighth: '0' unknown, 'f' free,
/// 'o' occupied, 'n' a node that follows.
inline std::string octree_node(const std::string& children) {
  std::uint16_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const unsigned kind = children.at(i) == 'n' ? 3U : children[i] == 'o' ? 2U : children[i] == 'f';
    bits = static_cast<std::uint16_t>(bits | (kind << (2 * i)));
  }
  return raw(bits);
}

/// A tree whose root and the nodes below lead to the voxels at the origin's corner, where all are
/// positive: `last` is the node of depth 16 - levels, and what follows it.
inline std::string octree_at_origin(const std::string& resolution, unsigned levels,
                                    const std::string& last, std::uint64_t more_nodes) {
  std::string tree = octree_node("0000000n");
  for (unsigned depth = 1; depth < 16 - levels; ++depth) tree += octree_node("n0000000");
  return octree(16 - levels + 1 + more_nodes, resolution, tree + last);
}

/// A name and the bytes of the same points in each format.
inline std::vector<std::pair<std::string, std::string>> all_clouds(const FilePoints& points) {
  return {{"ascii.ply", ply(points, "ascii")},
          {"little.ply", ply(points, "binary_little_endian")},
          {"big.ply", ply(points, "binary_big_endian")},
          {"ascii.pcd", pcd(points, "ascii")},
          {"binary.pcd", pcd(points, "binary")},
          {"compressed.pcd", pcd(points, "binary_compressed")},
          {"12.las", las(points)},
          {"13.las", las(points, {.minor = 3, .format = 5, .records = 2})},
          {"14.las", las(points, {.minor = 4, .format = 6, .extra = 3})}};
}

}  // namespace avoidbench::test
