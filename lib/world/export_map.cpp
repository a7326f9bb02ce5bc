#include "world/export_map.hpp"

#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "base/enum_text.hpp"
#include "base/input_error.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaterials = 7;
constexpr std::array<const char*, kMaterials> kMaterialNames{
    "soil", "bark", "leaf", "brick", "concrete", "painted_metal", "lamp"};
constexpr std::array<std::array<float, 3>, kMaterials> kMaterialColours{{{0.36F, 0.27F, 0.18F},
                                                                         {0.32F, 0.24F, 0.17F},
                                                                         {0.22F, 0.40F, 0.14F},
                                                                         {0.55F, 0.28F, 0.20F},
                                                                         {0.60F, 0.60F, 0.58F},
                                                                         {0.75F, 0.72F, 0.20F},
                                                                         {1.00F, 0.98F, 0.92F}}};

struct MeshFormat {
  std::string_view ending, assimp_id;
  bool keeps_instances;
};
constexpr std::array<MeshFormat, 4> kMeshFormats{{{".glb", "glb2", true},
                                                  {".obj", "obj", false},
                                                  {".ply", "plyb", false},
                                                  {".stl", "stlb", false}}};

/// Triangles of one material, ready for assimp.
struct Part {
  Material material = Material::soil;
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Adds the mesh's triangles, each to the part of its material.
void add_to_parts(const Prototype& prototype, const Eigen::Affine3f& place,
                  std::array<Part, kMaterials>& parts) {
  constexpr std::uint32_t kNone = ~0U;
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

aiMesh* assimp_mesh(const Part& part) {
  auto mesh = std::make_unique<aiMesh>();
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mMaterialIndex = static_cast<unsigned>(part.material);
  mesh->mNumVertices = static_cast<unsigned>(part.vertices.size());
  mesh->mVertices = new aiVector3D[part.vertices.size()];
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    mesh->mVertices[i] = {part.vertices[i].x(), part.vertices[i].y(), part.vertices[i].z()};
  }
  mesh->mNumFaces = static_cast<unsigned>(part.triangles.size());
  mesh->mFaces = new aiFace[part.triangles.size()];
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    mesh->mFaces[i].mNumIndices = 3;
    mesh->mFaces[i].mIndices = new unsigned[3];
    std::copy_n(part.triangles[i].begin(), 3, mesh->mFaces[i].mIndices);
  }
  return mesh.release();
}

template <class Object>
Object** array_of(const std::vector<Object*>& objects) {
  auto** array = new Object*[objects.size()];
  std::copy(objects.begin(), objects.end(), array);
  return array;
}

/// Adds the filled parts to the meshes; their numbers.
std::vector<unsigned> take_parts(const std::array<Part, kMaterials>& parts,
                                 std::vector<aiMesh*>& meshes) {
  std::vector<unsigned> numbers;
  for (const Part& part : parts) {
    if (part.triangles.empty()) continue;
    numbers.push_back(static_cast<unsigned>(meshes.size()));
    meshes.push_back(assimp_mesh(part));
  }
  return numbers;
}

void set_meshes(aiNode& node, const std::vector<unsigned>& meshes) {
  node.mNumMeshes = static_cast<unsigned>(meshes.size());
  node.mMeshes = new unsigned[meshes.size()];
  std::copy(meshes.begin(), meshes.end(), node.mMeshes);
}

aiMatrix4x4 assimp_matrix(const Eigen::Matrix4f& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3),
          m(2, 0), m(2, 1), m(2, 2), m(2, 3), m(3, 0), m(3, 1), m(3, 2), m(3, 3)};
}

/// One node an instance under a root that turns z up to y up.
void add_instanced(const World& world, aiNode& root, std::vector<aiMesh*>& meshes) {
  std::vector<std::vector<unsigned>> numbers;
  for (const Prototype& prototype : world.prototypes) {
    std::array<Part, kMaterials> parts;
    add_to_parts(prototype, Eigen::Affine3f::Identity(), parts);
    numbers.push_back(take_parts(parts, meshes));
  }
  std::vector<aiNode*> nodes;
  for (const Instance& instance : world.instances) {
    auto* node = new aiNode(world.obstacles[instance.obstacle].kind + '_' +
                            std::to_string(instance.obstacle));
    node->mTransformation = assimp_matrix(instance.T_world_prototype.matrix());
    node->mParent = &root;
    set_meshes(*node, numbers[instance.prototype]);
    nodes.push_back(node);
  }
  Eigen::Matrix4f y_up = Eigen::Matrix4f::Zero();
  y_up(0, 0) = y_up(1, 2) = y_up(3, 3) = 1.0F;
  y_up(2, 1) = -1.0F;
  root.mTransformation = assimp_matrix(y_up);
  root.mNumChildren = static_cast<unsigned>(nodes.size());
  root.mChildren = array_of(nodes);
}

void add_flattened(const World& world, aiNode& root, std::vector<aiMesh*>& meshes) {
  std::array<Part, kMaterials> parts;
  for (const Instance& instance : world.instances) {
    add_to_parts(world.prototypes[instance.prototype], instance.T_world_prototype, parts);
  }
  set_meshes(root, take_parts(parts, meshes));
}

std::unique_ptr<aiScene> assimp_scene(const World& world, bool keeps_instances) {
  auto scene = std::make_unique<aiScene>();
  std::vector<aiMaterial*> materials;
  for (std::size_t i = 0; i < kMaterials; ++i) {
    auto* material = new aiMaterial;
    const aiString name(kMaterialNames[i]);
    const auto& [r, g, b] = kMaterialColours[i];
    const aiColor4D colour(r, g, b, 1.0F);
    material->AddProperty(&name, AI_MATKEY_NAME);
    material->AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
    material->AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
    materials.push_back(material);
  }
  scene->mNumMaterials = static_cast<unsigned>(materials.size());
  scene->mMaterials = array_of(materials);
  scene->mRootNode = new aiNode("map");
  std::vector<aiMesh*> meshes;
  (keeps_instances ? add_instanced : add_flattened)(world, *scene->mRootNode, meshes);
  scene->mNumMeshes = static_cast<unsigned>(meshes.size());
  scene->mMeshes = array_of(meshes);
  return scene;
}

std::ofstream opened(const fs::path& file) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (!out) throw InputError(file.string() + ": can't be written");
  return out;
}

void finish(std::ofstream& out, const fs::path& file) {
  out.close();
  if (!out) throw InputError(file.string() + ": writing failed; is the disk full?");
}

void check_ending(const fs::path& file, std::string_view ending, std::string_view what) {
  if (file.extension() == ending) return;
  throw InputError(file.string() + ": the name of " + std::string(what) + " has to end in " +
                   std::string(ending));
}

static_assert(std::endian::native == std::endian::little);

}  // namespace

void export_mesh(const World& world, const fs::path& file) {
  const auto format =
      std::find_if(kMeshFormats.begin(), kMeshFormats.end(),
                   [&](const MeshFormat& known) { return file.extension() == known.ending; });
  if (format == kMeshFormats.end()) {
    throw InputError(file.string() + ": the name of a mesh has to end in .glb, .obj, .ply or .stl");
  }
  const std::unique_ptr<aiScene> scene = assimp_scene(world, format->keeps_instances);
  Assimp::Exporter exporter;
  if (exporter.Export(scene.get(), std::string(format->assimp_id), file.string()) !=
      aiReturn_SUCCESS) {
    throw InputError(file.string() + ": can't be written: " + exporter.GetErrorString());
  }
}

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
  std::ofstream out = opened(file);
  out << "ply\nformat binary_little_endian 1.0\ncomment avoidbench map, metres, z up\n"
      << "element vertex " << numbers.size() / 3
      << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(float)));
  finish(out, file);
}

void export_occupancy(const VoxelGrid& grid, const fs::path& file) {
  check_ending(file, ".npy", "an occupancy grid");
  std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (" +
                       std::to_string(grid.layers) + ", " + std::to_string(grid.rows) + ", " +
                       std::to_string(grid.columns) + "), }";
  // NumPy's format, version 1.0: the array begins at a multiple of 64 bytes.
  constexpr std::size_t kBefore = 10;
  header.resize((kBefore + header.size() + 1 + 63) / 64 * 64 - kBefore - 1, ' ');
  header += '\n';
  const auto length = static_cast<std::uint16_t>(header.size());
  std::ofstream out = opened(file);
  out.write("\x93NUMPY\x01\x00", 8);
  out.write(reinterpret_cast<const char*>(&length), 2);
  out << header;
  out.write(reinterpret_cast<const char*>(grid.is_occupied.data()),
            static_cast<std::streamsize>(grid.is_occupied.size()));
  finish(out, file);

  fs::path beside = file;
  beside += ".json";
  std::ofstream text = opened(beside);
  const Eigen::Vector3d& low = grid.lowest_world;
  text.precision(17);
  text << "{\"lowest_world_m\": [" << low.x() << ", " << low.y() << ", " << low.z()
       << "], \"resolution_m\": " << grid.size_m << ", \"axes\": \"z y x\"}\n";
  finish(text, beside);
}

}  // namespace avoidbench
