#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/poll.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/mesh_readers.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

/// Far below 2^53: every whole number of a JSON double is exact, and sums of two of them don't
/// overflow.
constexpr std::uint64_t kMostWhole = std::uint64_t{1} << 40U;

std::string place(const char* array, std::uint64_t index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

/// The bytes that base64 stands for; nothing where it is none.
std::optional<std::string> base64_decoded(std::string_view text) {
  // The number of letters says all that the padding says.
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t group = 0;
  unsigned bits = 0;
  // Six bits a letter; a byte is complete with each eighth bit.
  for (const char c : text) {
    std::uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = static_cast<std::uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      digit = static_cast<std::uint32_t>(c - 'a') + 26;
    } else if (c >= '0' && c <= '9') {
      digit = static_cast<std::uint32_t>(c - '0') + 52;
    } else if (c == '+' || c == '/') {
      digit = c == '+' ? 62 : 63;
    } else {
      return std::nullopt;
    }
    group = (group << 6U) | digit;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>((group >> bits) & 255U);
  }
  return bytes;
}

/// An accessor's numbers, all of them within its buffer.
struct Numbers {
  const char* first = nullptr;
  std::uint64_t count = 0, stride = 0;
  std::uint64_t component = 0;  ///< componentType
};

/// What is read of a file.
struct Gltf {
  const std::string& file;
  json root;
  std::string_view binary;  ///< the chunk BIN of a .glb
  std::map<std::uint64_t, std::string> decoded = {};

  [[noreturn]] void fail(const std::string& message) const { fail_file(file, message); }

  const json& element(const char* array, std::uint64_t index) const {
    const auto found = root.find(array);
    if (found == root.end() || !found->is_array() || index >= found->size() ||
        !(*found)[index].is_object()) {
      fail(place(array, index) + " is missing");
    }
    return (*found)[index];
  }

  std::uint64_t count(const char* array) const {
    const auto found = root.find(array);
    return found == root.end() || !found->is_array() ? 0 : found->size();
  }

  /// Values are never copied: they may be nested a million deep, and copying is recursive.
  std::uint64_t whole_number(const json& value, const char* what) const {
    const double number = value.is_number() ? value.get<double>() : -1.0;
    if (number >= 0.0 && number < static_cast<double>(kMostWhole) && std::floor(number) == number) {
      return static_cast<std::uint64_t>(number);
    }
    fail(std::string(what) + " is not a whole number");
  }

  /// A whole number of an object; nothing where the key is missing.
  std::optional<std::uint64_t> whole(const json& object, const char* key) const {
    const auto found = object.find(key);
    if (found == object.end()) return std::nullopt;
    return whole_number(*found, key);
  }

  std::uint64_t needed(const json& object, const char* key) const {
    const auto value = whole(object, key);
    if (!value) fail(std::string(key) + " is missing");
    return *value;
  }

  // The bytes of a buffer: the chunk BIN, or base64 within the JSON, which is decoded once. Other
  // files are not opened: a map is one file with one digest.
  std::string_view buffer(std::uint64_t index) {
    const json& buffer = element("buffers", index);
    const std::uint64_t length = needed(buffer, "byteLength");
    std::string_view bytes = binary;
    const auto uri = buffer.find("uri");
    if (uri != buffer.end()) {
      const std::string_view text =
          uri->is_string() ? uri->get_ref<const std::string&>() : std::string_view();
      const std::size_t comma = text.find(";base64,");
      if (!text.starts_with("data:") || comma == std::string_view::npos) {
        fail(place("buffers", index) + " is in another file, " + in_quotes(text) +
             ": buffers must be inside the file; export it as .glb");
      }
      if (!decoded.contains(index)) {
        auto content = base64_decoded(text.substr(comma + 8));
        if (!content) fail(place("buffers", index) + " is not base64");
        decoded[index] = std::move(*content);
      }
      bytes = decoded[index];
    } else if (index != 0 || binary.empty()) {
      // Only the first buffer may be without uri: it is the chunk BIN.
      fail(place("buffers", index) + " has no bytes");
    }
    // There may be more: chunks are filled up to four bytes.
    if (length > bytes.size()) {
      fail("is truncated: " + place("buffers", index) + " has " + std::to_string(length) +
           " bytes, there are " + std::to_string(bytes.size()));
    }
    return bytes.substr(0, length);
  }

  /// The numbers of an accessor of this type, `numbers` of them in an element.
  Numbers accessor(std::uint64_t index, std::string_view type, std::uint64_t numbers) {
    const json& accessor = element("accessors", index);
    const std::string name = place("accessors", index);
    if (accessor.contains("sparse")) fail(name + " is sparse, which is not supported");
    const auto kind = accessor.find("type");
    if (kind == accessor.end() || *kind != type) fail(name + " is no " + std::string(type));
    Numbers found;
    found.component = needed(accessor, "componentType");
    found.count = needed(accessor, "count");
    // accessor → bufferView → buffer: each must lie within the next. Without a bufferView an
    // accessor would be all zeros, which no mesh needs.
    const json& view = element("bufferViews", needed(accessor, "bufferView"));
    std::string_view bytes = buffer(needed(view, "buffer"));
    const std::uint64_t from = whole(view, "byteOffset").value_or(0);
    const std::uint64_t length = needed(view, "byteLength");
    if (from > bytes.size() || length > bytes.size() - from) {
      fail(name + ": its bufferView is not within its buffer");
    }
    bytes = bytes.substr(from, length);
    const std::uint64_t offset = whole(accessor, "byteOffset").value_or(0);
    const std::uint64_t size = numbers * component_size(found.component, name);
    found.stride = whole(view, "byteStride").value_or(0);
    if (found.stride == 0) found.stride = size;
    // glTF's own limit.
    if (found.stride < size || found.stride > 252) fail(name + ": byteStride can't be");
    // By dividing: count · stride of a damaged file could overflow.
    const bool is_inside =
        found.count == 0 || (offset <= length && size <= length - offset &&
                             found.count - 1 <= (length - offset - size) / found.stride);
    if (!is_inside) fail(name + " is not within its bufferView");
    found.first = bytes.data() + offset;
    return found;
  }

  // Unsigned byte, unsigned short, unsigned int, float; signed ones hold no positions or indices.
  std::uint64_t component_size(std::uint64_t component, const std::string& name) const {
    if (component == 5121) return 1;
    if (component == 5123) return 2;
    if (component == 5125 || component == 5126) return 4;
    fail(name + ": componentType " + std::to_string(component) + " is not supported");
  }

  std::vector<Eigen::Vector3f> positions(std::uint64_t index) {
    const Numbers numbers = accessor(index, "VEC3", 3);
    if (numbers.component != 5126) fail(place("accessors", index) + ": positions must be float");
    std::vector<Eigen::Vector3f> all(numbers.count);
    for (std::uint64_t i = 0; i < numbers.count; ++i) {
      std::memcpy(all[i].data(), numbers.first + i * numbers.stride, 12);
      if (all[i].allFinite()) continue;
      fail(place("accessors", index) + ": vertex " + std::to_string(i) + " is not finite");
    }
    return all;
  }

  std::vector<std::uint64_t> indices(std::uint64_t index) {
    const Numbers numbers = accessor(index, "SCALAR", 1);
    if (numbers.component == 5126) fail(place("accessors", index) + ": indices must be whole");
    const NumberType type = numbers.component == 5121   ? NumberType::u8
                            : numbers.component == 5123 ? NumberType::u16
                                                        : NumberType::u32;
    std::vector<std::uint64_t> all(numbers.count);
    for (std::uint64_t i = 0; i < numbers.count; ++i) {
      all[i] =
          static_cast<std::uint64_t>(load_number(numbers.first + i * numbers.stride, type, false));
    }
    return all;
  }
};

/// Lists, strips and fans as a list of triangles.
std::vector<std::uint64_t> triangle_list(const std::vector<std::uint64_t>& corners,
                                         std::uint64_t mode) {
  std::vector<std::uint64_t> list;
  if (corners.size() < 3) return list;
  // 4: triangles, 5: strip, 6: fan.
  if (mode == 4) {
    list = corners;
    list.resize(corners.size() / 3 * 3);
    return list;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    // In a strip every second triangle is turned round, as its corners come the other way.
    const std::size_t odd = i % 2;
    const std::array<std::uint64_t, 3> triangle =
        mode == 5 ? std::array{corners[i], corners[i + 1 + odd], corners[i + 2 - odd]}
                  : std::array{corners[0], corners[i + 1], corners[i + 2]};
    list.insert(list.end(), triangle.begin(), triangle.end());
  }
  return list;
}

/// The product of a node's translation, rotation and scale, or its matrix, column by column.
Eigen::Affine3d transform_of(const Gltf& from, const json& node) {
  // A list of numbers of this length; `usual` where the key is missing.
  const auto numbers = [&]<std::size_t count>(const char* key, std::array<float, count> usual) {
    const auto found = node.find(key);
    if (found == node.end()) return usual;
    bool is_right = found->is_array() && found->size() == count;
    for (std::size_t k = 0; is_right && k < count; ++k) {
      const json& number = (*found)[k];
      is_right = number.is_number() && std::isfinite(number.get<float>());
      if (is_right) usual[k] = number.get<float>();
    }
    if (!is_right) from.fail(std::string("a node's ") + key + " is wrong");
    return usual;
  };
  const auto matrix = numbers("matrix", std::array<float, 16>{});
  const auto t = numbers("translation", std::array{0.0F, 0.0F, 0.0F});
  const auto [x, y, z, w] = numbers("rotation", std::array{0.0F, 0.0F, 0.0F, 1.0F});
  const auto s = numbers("scale", std::array{1.0F, 1.0F, 1.0F});
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  if (node.contains("matrix")) {
    T.matrix() = Eigen::Map<const Eigen::Matrix4f>(matrix.data()).cast<double>();
    // The last row is taken as 0 0 0 1, whatever it says.
    T.makeAffine();
    return T;
  }
  // In single precision, from which maps have their digests.
  Eigen::Matrix3f linear;
  // The rotation's matrix, of a unit quaternion.
  linear << 1.0F - 2.0F * (y * y + z * z), 2.0F * (x * y - z * w), 2.0F * (x * z + y * w),
      2.0F * (x * y + z * w), 1.0F - 2.0F * (x * x + z * z), 2.0F * (y * z - x * w),
      2.0F * (x * z - y * w), 2.0F * (y * z + x * w), 1.0F - 2.0F * (x * x + y * y);
  for (Eigen::Index k = 0; k < 3; ++k) linear.col(k) *= s[static_cast<std::size_t>(k)];
  T.linear() = linear.cast<double>();
  T.translation() = Eigen::Vector3f(t[0], t[1], t[2]).cast<double>();
  return T;
}

/// "" where it has none.
std::string_view name_of(const json& object) {
  const auto name = object.find("name");
  const bool is_text = name != object.end() && name->is_string();
  return is_text ? std::string_view(name->get_ref<const std::string&>()) : std::string_view();
}

/// Gathers the parts: one a node with triangles, so that a mesh of several nodes stands in several
/// parts.
struct Gatherer {
  Gltf& from;
  const MeshSource& source;

  /// The triangles of one material of a mesh.
  struct Surface {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Material material;
  };
  // Read once each; nodes then take copies.
  std::vector<std::vector<Surface>> meshes = {};
  std::uint64_t triangle_count = 0;
  std::vector<bool> is_there = {};  ///< which nodes
  std::vector<MeshPart> parts = {};

  void count(std::uint64_t triangles) {
    triangle_count += triangles;
    if (triangle_count > source.most_triangles) fail_triangles(source);
  }

  Material material_of(const json& primitive) const {
    const auto index = from.whole(primitive, "material");
    if (!index) return source.fallback;
    return material_named(name_of(from.element("materials", *index)), source.fallback);
  }

  void add_primitive(const json& primitive, const std::string& name, std::vector<Surface>& to) {
    poll_caller();
    if (!primitive.is_object()) from.fail(name + ": a primitive is not an object");
    const std::uint64_t mode = from.whole(primitive, "mode").value_or(4);
    if (mode < 4) return;  // points and lines
    if (mode > 6) from.fail(name + ": mode " + std::to_string(mode) + " is not known");
    if (primitive.contains("extensions") &&
        primitive["extensions"].contains("KHR_draco_mesh_compression")) {
      from.fail(name + " is compressed with Draco, which is not supported; export it uncompressed");
    }
    // A primitive without positions is nothing to bump into.
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object()) return;
    const auto position = from.whole(*attributes, "POSITION");
    if (!position) return;
    const std::vector<Eigen::Vector3f> vertices = from.positions(*position);
    // Without indices the vertices are the corners, in order.
    std::vector<std::uint64_t> corners(vertices.size());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = i;
    if (const auto index = from.whole(primitive, "indices")) corners = from.indices(*index);
    corners = triangle_list(corners, mode);
    if (corners.empty()) return;
    count(corners.size() / 3);
    // Vertices may be shared by primitives: each surface keeps only those that it names, in order.
    std::vector<std::uint64_t> used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (used.back() >= vertices.size()) from.fail(name + ": an index names no vertex");
    Surface surface{.vertices = {}, .triangles = {}, .material = material_of(primitive)};
    for (const std::uint64_t i : used) surface.vertices.push_back(vertices[i]);
    const auto index_of = [&](std::uint64_t corner) {
      const auto at = std::lower_bound(used.begin(), used.end(), corner);
      return static_cast<std::uint32_t>(at - used.begin());
    };
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      poll_caller();
      surface.triangles.push_back(
          {index_of(corners[i]), index_of(corners[i + 1]), index_of(corners[i + 2])});
    }
    to.push_back(std::move(surface));
  }

  void add_meshes() {
    for (std::uint64_t i = 0; i < from.count("meshes"); ++i) {
      const json& mesh = from.element("meshes", i);
      meshes.emplace_back();
      const auto found = mesh.find("primitives");
      if (found == mesh.end() || !found->is_array()) continue;
      for (const json& primitive : *found) {
        add_primitive(primitive, place("meshes", i), meshes.back());
      }
    }
  }

  void add_surface(const Surface& surface, const Eigen::Affine3d& T_file_mesh, MeshPart& part) {
    // A small mesh that many nodes use is large as a map.
    count(surface.triangles.size());
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    // A mirrored mesh turns inside out: its corners are put back in order.
    const bool is_mirrored = T_file_mesh.linear().determinant() < 0.0;
    for (auto [a, b, c] : surface.triangles) {
      poll_caller();
      if (is_mirrored) std::swap(b, c);
      part.triangles.push_back({first + a, first + b, first + c});
      part.materials.push_back(surface.material);
    }
    for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
      const Eigen::Vector3d vertex = T_file_mesh * surface.vertices[i].cast<double>();
      if (!vertex.allFinite()) {
        from.fail("vertex " + std::to_string(i) + " of '" + part.kind + "' is not finite");
      }
      part.vertices.push_back(vertex + Eigen::Vector3d::Zero());  // -0 becomes 0
    }
  }

  /// Adds the node and those below; each may be there once, so that they are a tree.
  void add_node(std::uint64_t index, const Eigen::Affine3d& T_file_parent, int depth) {
    // It calls itself: a deeper chain of nodes would use up the stack.
    constexpr int kMostDepth = 200;
    const json& node = from.element("nodes", index);
    const std::string name = place("nodes", index);
    if (is_there[index]) from.fail(name + " is below two others or below itself");
    if (depth > kMostDepth) from.fail("its nodes are nested deeper than 200");
    is_there[index] = true;
    const Eigen::Affine3d T_file_node = T_file_parent * transform_of(from, node);
    const auto extensions = node.find("extensions");
    if (extensions != node.end() && extensions->contains("EXT_mesh_gpu_instancing")) {
      from.fail(name +
                " has several instances (EXT_mesh_gpu_instancing), which is not supported; "
                "export a node for each");
    }
    if (const auto index_of_mesh = from.whole(node, "mesh")) {
      const json& mesh = from.element("meshes", *index_of_mesh);
      MeshPart part;
      part.kind = obstacle_kind(name_of(node));
      if (part.kind == "mesh") part.kind = obstacle_kind(name_of(mesh));
      for (const Surface& surface : meshes[*index_of_mesh]) add_surface(surface, T_file_node, part);
      parts.push_back(std::move(part));
    }
    const auto children = node.find("children");
    if (children == node.end() || !children->is_array()) return;
    for (const json& child : *children) {
      add_node(from.whole_number(child, "a node's child"), T_file_node, depth + 1);
    }
  }

  void add_scene() {
    is_there.assign(from.count("nodes"), false);
    triangle_count = 0;  // from here on those of nodes, not of meshes
    const json& scene = from.element("scenes", from.whole(from.root, "scene").value_or(0));
    const auto found = scene.find("nodes");
    if (found == scene.end() || !found->is_array() || found->empty()) {
      from.fail("its scene has no nodes");
    }
    for (const json& root : *found) {
      add_node(from.whole_number(root, "a scene's node"), Eigen::Affine3d::Identity(), 0);
    }
  }
};

/// Takes the chunks JSON and BIN out of a .glb file.
std::string_view take_chunks(std::string_view bytes, const std::string& file,
                             std::string_view& binary) {
  const auto word = [&](std::size_t at) { return load<std::uint32_t>(bytes.data() + at, false); };
  // 12 of the header and 8 of a first chunk.
  if (bytes.size() < 20) fail_file(file, "is truncated: a .glb file has 20 bytes at least");
  if (word(4) != 2) fail_file(file, "is glTF " + std::to_string(word(4)) + "; 2 is read");
  if (word(8) > bytes.size()) {
    fail_file(file, "is truncated: it promises " + std::to_string(word(8)) + " bytes and has " +
                        std::to_string(bytes.size()));
  }
  bytes = bytes.substr(0, word(8));
  std::string_view text;
  // The first chunk of each kind counts; kinds that are not known are passed over, as glTF says.
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = word(at);
    const std::string_view kind = bytes.substr(at + 4, 4);
    if (size > bytes.size() - at - 8) {
      fail_file(file, "is truncated: the chunk at byte " + std::to_string(at) + " has " +
                          std::to_string(size) + " bytes");
    }
    if (kind == "JSON" && text.empty()) text = bytes.substr(at + 8, size);
    if (kind == std::string_view("BIN\0", 4) && binary.empty()) binary = bytes.substr(at + 8, size);
    at += 8 + size;
  }
  return text;
}

}  // namespace

std::vector<MeshPart> parse_gltf(const MeshSource& source) {
  const std::string& file = source.file;
  std::string_view bytes = source.bytes;
  Gltf gltf{.file = file, .root = {}, .binary = {}};
  if (bytes.starts_with("glTF")) bytes = take_chunks(bytes, file, gltf.binary);
  try {
    gltf.root = json::parse(bytes);
  } catch (const json::parse_error& error) {
    fail_file(file, "is not glTF: its JSON ends or is wrong at byte " + std::to_string(error.byte));
  } catch (const json::out_of_range&) {
    fail_file(file, "is not glTF: a number of its JSON is too large");
  }
  if (!gltf.root.is_object()) fail_file(file, "is not glTF: its JSON is not an object");
  const auto asset = gltf.root.find("asset");
  const bool has_asset = asset != gltf.root.end() && asset->is_object();
  const auto version = has_asset ? asset->find("version") : gltf.root.end();
  if (!has_asset || version == asset->end() || !version->is_string() ||
      !version->get_ref<const std::string&>().starts_with("2.")) {
    fail_file(file, "is not glTF of version 2");
  }
  // All meshes first, then the scene, which says where they stand.
  Gatherer gatherer{.from = gltf, .source = source};
  gatherer.add_meshes();
  if (gatherer.triangle_count == 0) fail_file(file, "has no triangles");
  gatherer.add_scene();
  return std::move(gatherer.parts);
}

}  // namespace avoidbench
