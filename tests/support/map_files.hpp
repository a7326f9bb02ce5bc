#pragma once

#include <stdlib.h>

#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

/// Map files to read, written by the test itself.
namespace avoidbench::test {

/// A folder of its own, gone with the object.
struct TemporaryFolder {
  std::filesystem::path path;
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "avoidbench_XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return (path / name).string();
  }
};

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

/// An LZF stream that copies nothing.
inline std::string lzf_literals(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 32) {
    const std::string piece = bytes.substr(i, 32);
    out += static_cast<char>(piece.size() - 1) + piece;
  }
  return out;
}

}  // namespace avoidbench::test
