#include "map_file/export_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "base/input_error.hpp"
#include "base/npy_header.hpp"
#include "base/output_file.hpp"
#include "map_file/material_looks.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Triangles of one material.
struct Part {
  Material material = Material::soil;
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
using Parts = std::array<Part, kMaterials>;

/// Adds the mesh's triangles, each to the part of its material.
void add_to_parts(const Prototype& prototype, const Eigen::Affine3f& place, Parts& parts) {
  constexpr std::uint32_t kNone = ~0U;
  // A vertex is copied into each part that uses it, once.
  std::array<std::vector<std::uint32_t>, kMaterials> numbers;  // of a vertex within a part
  for (std::size_t i = 0; i < prototype.mesh.triangles.size(); ++i) {
    const auto material = static_cast<std::size_t>(prototype.triangle_materials[i]);
    Part& part = parts[material];
    part.material = prototype.triangle_materials[i];
    std::vector<std::uint32_t>& number = numbers[material];
    if (number.empty()) number.assign(prototype.mesh.vertices.size(), kNone);
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = prototype.mesh.triangles[i][k];
      if (number[vertex] == kNone) {
        number[vertex] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.emplace_back(place * prototype.mesh.vertices[vertex]);
      }
      corners[k] = number[vertex];
    }
    part.triangles.push_back(corners);
  }
}

/// Every instance at its place, by material.
Parts flattened(const World& world) {
  Parts parts;
  for (const Instance& instance : world.instances) {
    add_to_parts(world.prototypes[instance.prototype], instance.T_world_prototype, parts);
  }
  return parts;
}

/// As it is in memory, which is little-endian as these formats want it (see the assertion below).
template <class T>
void add_raw(const T& value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void add_raw(const Eigen::Vector3f& v, std::string& bytes) {
  for (const float value : v) add_raw(value, bytes);
}

/// As short as says the same number again.
void add_text(float value, std::string& text) {
  std::array<char, 32> digits{};
  text.append(digits.begin(), std::to_chars(digits.begin(), digits.end(), value).ptr);
}

void check_ending(const fs::path& file, std::string_view ending, std::string_view what) {
  if (file.extension() == ending) return;
  throw InputError(file.string() + ": the name of " + std::string(what) + " has to end in " +
                   std::string(ending));
}

/// Gathers the buffer of a .glb file and the JSON that says what is in it.
struct GlbWriter {
  std::string buffer = {};
  json out = {{"asset", {{"version", "2.0"}, {"generator", "avoidbench"}}},
              {"scene", 0},
              {"scenes", json::array({{{"nodes", json::array({0})}}})}};

  /// The accessor of what was added to the buffer from `begin` on.
  json& add_accessor(std::size_t begin, std::size_t count, const char* type, int component,
                     int target) {
    out["bufferViews"].push_back({{"buffer", 0},
                                  {"byteOffset", begin},
                                  {"byteLength", buffer.size() - begin},
                                  {"target", target}});
    out["accessors"].push_back({{"bufferView", out["bufferViews"].size() - 1},
                                {"componentType", component},
                                {"count", count},
                                {"type", type}});
    return out["accessors"].back();
  }

  json primitive_of(const Part& part) {
    // OpenGL's numbers, by which glTF names types and uses of buffers.
    constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertices = 34962, kIndices = 34963;
    std::size_t begin = buffer.size();
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& vertex : part.vertices) {
      add_raw(vertex, buffer);
      box.extend(vertex);
    }
    json& positions = add_accessor(begin, part.vertices.size(), "VEC3", kFloat, kVertices);
    // glTF demands the bounds of positions.
    positions["min"] = {box.min().x(), box.min().y(), box.min().z()};
    positions["max"] = {box.max().x(), box.max().y(), box.max().z()};
    begin = buffer.size();
    for (const auto& triangle : part.triangles) add_raw(triangle, buffer);
    add_accessor(begin, 3 * part.triangles.size(), "SCALAR", kUnsignedInt, kIndices);
    const std::size_t last = out["accessors"].size() - 1;
    return {{"attributes", {{"POSITION", last - 1}}},
            {"indices", last},
            {"material", static_cast<std::size_t>(part.material)}};
  }

  void add_materials() {
    for (std::size_t i = 0; i < kMaterials; ++i) {
      const auto& [r, g, b] = kMaterialColours[i];
      out["materials"].push_back(
          {{"name", kMaterialNames[i]},
           {"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, 1.0}}, {"metallicFactor", 0}}}});
    }
  }

  void add_meshes(const World& world) {
    for (const Prototype& prototype : world.prototypes) {
      Parts parts;
      add_to_parts(prototype, Eigen::Affine3f::Identity(), parts);
      json primitives = json::array();
      for (const Part& part : parts) {
        if (!part.triangles.empty()) primitives.push_back(primitive_of(part));
      }
      out["meshes"].push_back({{"name", prototype.name}, {"primitives", primitives}});
    }
  }

  /// One node an instance under a root that turns z up to y up.
  void add_nodes(const World& world) {
    // Column by column: x stays, y goes to −z, z to y.
    out["nodes"].push_back({{"name", "map"},
                            {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}},
                            {"children", json::array()}});
    for (const Instance& instance : world.instances) {
      const std::string name =
          world.obstacles[instance.obstacle].kind + '_' + std::to_string(instance.obstacle);
      json matrix = json::array();
      // Column by column, in both.
      for (const float number : instance.T_world_prototype.matrix().reshaped()) {
        matrix.push_back(number);
      }
      out["nodes"][0]["children"].push_back(out["nodes"].size());
      out["nodes"].push_back(
          {{"name", name}, {"mesh", instance.prototype}, {"matrix", std::move(matrix)}});
    }
  }

  std::string bytes() {
    out["buffers"] = json::array({{{"byteLength", buffer.size()}}});
    std::string text = out.dump();
    // Chunks are multiples of four bytes: JSON is filled up with blanks, the buffer has only
    // numbers of four.
    text.resize((text.size() + 3) / 4 * 4, ' ');
    // A header of 12 bytes, and 8 before each of two chunks.
    const std::size_t size = 28 + text.size() + buffer.size();
    if (size > std::numeric_limits<std::uint32_t>::max()) {
      throw InputError("the map is too large for .glb, which holds 4 GiB; write .ply");
    }
    const auto add_word = [](std::size_t value, std::string& to) {
      add_raw(static_cast<std::uint32_t>(value), to);
    };
    std::string all = "glTF";
    // Version 2 of the container.
    add_word(2, all);
    add_word(size, all);
    add_word(text.size(), all);
    all += "JSON" + text;
    add_word(buffer.size(), all);
    return all + std::string("BIN\0", 4) + buffer;
  }
};

void write_glb(const World& world, const fs::path& file) {
  GlbWriter writer;
  writer.add_materials();
  writer.add_meshes(world);
  writer.add_nodes(world);
  const std::string bytes = writer.bytes();
  std::ofstream out = open_output(file);
  out << bytes;
  close_output(out, file);
}

/// With a library of the materials' colours beside it.
void write_obj(const World& world, const fs::path& file) {
  fs::path library = file;
  library.replace_extension(".mtl");
  check_output_file(library);  // before the mesh is begun
  std::ofstream out = open_output(file), materials = open_output(library);
  out << "# avoidbench map, metres, z up\nmtllib " << library.filename().string() << "\no map\n";
  std::size_t first = 1;  // OBJ numbers vertices over the whole file
  for (const Part& part : flattened(world)) {
    if (part.triangles.empty()) continue;
    const auto material = static_cast<std::size_t>(part.material);
    const auto& [r, g, b] = kMaterialColours[material];
    materials << "newmtl " << kMaterialNames[material] << "\nKd " << r << ' ' << g << ' ' << b
              << '\n';
    std::string text = std::string("usemtl ") + kMaterialNames[material] + '\n';
    for (const Eigen::Vector3f& vertex : part.vertices) {
      text += 'v';
      for (const float value : vertex) add_text(value, text += ' ');
      text += '\n';
    }
    for (const auto& triangle : part.triangles) {
      text += 'f';
      for (const std::uint32_t corner : triangle) text += ' ' + std::to_string(first + corner);
      text += '\n';
    }
    out << text;
    first += part.vertices.size();
  }
  close_output(out, file);
  close_output(materials, library);
}

void write_ply(const World& world, const fs::path& file) {
  std::string vertices, faces;
  std::uint32_t first = 0;
  std::size_t triangles = 0;
  for (const Part& part : flattened(world)) {
    for (const Eigen::Vector3f& vertex : part.vertices) add_raw(vertex, vertices);
    for (const auto& triangle : part.triangles) {
      // The count of the list, one byte.
      faces += '\3';
      for (const std::uint32_t corner : triangle) add_raw(first + corner, faces);
    }
    first += static_cast<std::uint32_t>(part.vertices.size());
    triangles += part.triangles.size();
  }
  std::ofstream out = open_output(file);
  out << "ply\nformat binary_little_endian 1.0\ncomment avoidbench map, metres, z up\n"
      << "element vertex " << first
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << triangles
      << "\nproperty list uchar uint vertex_indices\nend_header\n"
      << vertices << faces;
  close_output(out, file);
}

void write_stl(const World& world, const fs::path& file) {
  constexpr std::size_t kHeader = 80;
  std::string bytes = "avoidbench map, metres, z up";
  bytes.resize(kHeader, ' ');
  std::uint32_t triangles = 0;
  const Parts parts = flattened(world);
  for (const Part& part : parts) triangles += static_cast<std::uint32_t>(part.triangles.size());
  add_raw(triangles, bytes);
  for (const Part& part : parts) {
    for (const auto& [a, b, c] : part.triangles) {
      const auto& [from, left, right] =
          std::tie(part.vertices[a], part.vertices[b], part.vertices[c]);
      // The triangle's normal; zero for one without an area.
      add_raw((left - from).cross(right - from).normalized().eval(), bytes);
      for (const Eigen::Vector3f* corner : {&from, &left, &right}) add_raw(*corner, bytes);
      // The count of attribute bytes: none.
      bytes.append(2, '\0');
    }
  }
  std::ofstream out = open_output(file);
  out << bytes;
  close_output(out, file);
}

struct MeshFormat {
  std::string_view ending;
  void (*write)(const World&, const fs::path&);
};
constexpr std::array<MeshFormat, 4> kMeshFormats{
    {{".glb", write_glb}, {".obj", write_obj}, {".ply", write_ply}, {".stl", write_stl}}};

static_assert(std::endian::native == std::endian::little);

}  // namespace

void export_mesh(const World& world, const fs::path& file) {
  const auto format =
      std::find_if(kMeshFormats.begin(), kMeshFormats.end(),
                   [&](const MeshFormat& known) { return file.extension() == known.ending; });
  if (format == kMeshFormats.end()) {
    throw InputError(file.string() + ": the name of a mesh has to end in .glb, .obj, .ply or .stl");
  }
  format->write(world, file);
}

/// One point in the middle of each full voxel.
void export_point_cloud(const VoxelGrid& grid, const fs::path& file) {
  check_ending(file, ".ply", "a point cloud");
  std::vector<float> numbers;
  for (std::size_t layer = 0; layer < grid.layers; ++layer) {
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        if (grid.is_occupied[grid.at(column, row, layer)] == 0) continue;
        const Eigen::Vector3f centre = grid.centre_world(column, row, layer).cast<float>();
        numbers.insert(numbers.end(), {centre.x(), centre.y(), centre.z()});
      }
    }
  }
  std::ofstream out = open_output(file);
  out << "ply\nformat binary_little_endian 1.0\ncomment avoidbench map, metres, z up\n"
      << "element vertex " << numbers.size() / 3
      << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(float)));
  close_output(out, file);
}

/// The grid's bytes as they are, z slowest, x fastest; beside it a JSON file that says where it
/// lies, which NumPy's format has no place for.
void export_occupancy(const VoxelGrid& grid, const fs::path& file) {
  check_ending(file, ".npy", "an occupancy grid");
  fs::path beside = file;
  beside += ".json";
  check_output_file(beside);  // before the grid is begun
  std::ofstream out = open_output(file);
  out << npy_header("|u1", std::array{grid.layers, grid.rows, grid.columns});
  out.write(reinterpret_cast<const char*>(grid.is_occupied.data()),
            static_cast<std::streamsize>(grid.is_occupied.size()));
  close_output(out, file);

  std::ofstream text = open_output(beside);
  const Eigen::Vector3d& low = grid.lowest_world;
  // Enough digits to read back the same double.
  text.precision(17);
  text << "{\"lowest_world_m\": [" << low.x() << ", " << low.y() << ", " << low.z()
       << "], \"resolution_m\": " << grid.size_m << ", \"axes\": \"z y x\"}\n";
  close_output(text, beside);
}

}  // namespace avoidbench
