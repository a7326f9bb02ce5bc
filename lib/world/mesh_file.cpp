#include "world/mesh_file.hpp"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>

#include "world/plain_mesh.hpp"

namespace avoidbench {
namespace {

/// The one file that the importer may see.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {}
  bool Exists(const char* file) const override { return file == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    if (file != name_) return nullptr;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(bytes_.data());
    return new Assimp::MemoryIOStream(bytes, bytes_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::string_view bytes_;
};

std::string_view text_of(const aiString& string) { return {string.data, string.length}; }

/// A message of the importer's, on one line of plain characters.
std::string plain_text(std::string_view message) {
  constexpr std::size_t kMost = 200;
  std::string text;
  for (const char c : message.substr(0, kMost)) text += c >= ' ' && c <= '~' ? c : ' ';
  return text;
}

Material material_of(const aiScene& scene, const aiMesh& mesh, Material fallback) {
  aiString name;
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return fallback;
  if (scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name) != AI_SUCCESS) {
    return fallback;
  }
  return enum_from_text<Material>(obstacle_kind(text_of(name))).value_or(fallback);
}

Eigen::Affine3d affine(const aiMatrix4x4& m) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      T.matrix()(row, column) = static_cast<double>(m[row][column]);
    }
  }
  return T;
}

/// Gathers the parts from the tree of nodes.
struct Gatherer {
  const aiScene& scene;
  const std::string& file;
  Material fallback;
  std::uint64_t most_triangles;
  bool is_gltf;
  Eigen::Vector3d offset;  ///< to be added to positions
  std::uint64_t triangle_count = 0;
  std::vector<MeshPart> parts = {};

  void add_mesh(const aiMesh& mesh, const Eigen::Affine3d& T_file_mesh, MeshPart& part) {
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    const bool is_mirrored = T_file_mesh.linear().determinant() < 0.0;
    const Material material = material_of(scene, mesh, fallback);
    const std::size_t triangles_before = part.triangles.size();
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<std::uint32_t, 3> corners{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
      for (std::uint32_t& corner : corners) {
        if (corner >= mesh.mNumVertices) fail_file(file, "a face names a vertex that is not there");
        corner += first;
      }
      if (is_mirrored) std::swap(corners[1], corners[2]);
      part.triangles.push_back(corners);
      part.materials.push_back(material);
    }
    if (part.triangles.size() == triangles_before) return;
    triangle_count += part.triangles.size() - triangles_before;
    if (triangle_count > most_triangles) fail_triangles(file, most_triangles);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      const Eigen::Vector3d vertex =
          T_file_mesh * Eigen::Vector3d(static_cast<double>(v.x), static_cast<double>(v.y),
                                        static_cast<double>(v.z));
      if (!vertex.allFinite()) {
        fail_file(file, "vertex " + std::to_string(i) + " of '" +
                            obstacle_kind(text_of(mesh.mName)) + "' is not finite");
      }
      part.vertices.push_back(vertex + offset);
    }
  }

  /// Whether the node is no node of the file: assimp puts what has none below one of its own.
  bool is_assimps(const aiNode& node) const { return node.mParent == nullptr && !is_gltf; }

  void add_node(const aiNode& node, const Eigen::Affine3d& T_file_parent, int depth) {
    constexpr int kMostDepth = 1000;
    if (depth > kMostDepth) fail_file(file, "its nodes are nested too deep");
    const Eigen::Affine3d T_file_node = T_file_parent * affine(node.mTransformation);
    MeshPart part;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
      if (part.kind.empty()) {
        part.kind = obstacle_kind(text_of(is_assimps(node) ? mesh.mName : node.mName));
      }
      if (part.kind == "mesh") part.kind = obstacle_kind(text_of(mesh.mName));
      add_mesh(mesh, T_file_node, part);
    }
    if (!part.triangles.empty()) parts.push_back(std::move(part));
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      add_node(*node.mChildren[i], T_file_node, depth + 1);
    }
  }
};

PlainMesh plain_mesh(std::string_view bytes, const std::string& file,
                     std::uint64_t most_triangles) {
  const std::string extension = extension_of(file);
  if (extension == "obj") return plain_obj(bytes, file, most_triangles);
  if (extension == "ply") return plain_ply(bytes, file, most_triangles);
  if (extension == "stl") return plain_stl(bytes, file, most_triangles);
  return plain_gltf(bytes, file, most_triangles);
}

}  // namespace

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
  if (kind.empty() || kind == "defaultobject" || kind == "nodes") return "mesh";
  if (kind == "floor" || kind == "terrain") return "ground";
  return kind == "roof" ? "ceiling" : kind;
}

std::vector<MeshPart> parse_mesh(std::string_view bytes, const std::string& file, Material fallback,
                                 std::uint64_t most_triangles) {
  const PlainMesh plain = plain_mesh(bytes, file, most_triangles);
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFile(plain.name, plain.bytes));  // the importer owns it
  const aiScene* scene = nullptr;
  std::string reason;
  try {
    scene = importer.ReadFile(plain.name, aiProcess_Triangulate);
    if (scene == nullptr) reason = importer.GetErrorString();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    fail_file(file, "can't be read as a mesh: " + plain_text(reason));
  }
  Gatherer gatherer{*scene, file, fallback, most_triangles, plain.name == "map.glb", plain.offset};
  gatherer.add_node(*scene->mRootNode, Eigen::Affine3d::Identity(), 0);
  if (gatherer.parts.empty()) fail_file(file, "has no triangles");
  return std::move(gatherer.parts);
}

}  // namespace avoidbench
