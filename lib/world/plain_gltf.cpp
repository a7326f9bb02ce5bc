#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "world/cloud_bytes.hpp"
#include "world/plain_mesh.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostWhole = std::uint64_t{1} << 40U;

std::string place(const char* array, std::uint64_t index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

/// The bytes that base64 stands for; nothing where it is none.
std::optional<std::string> base64_decoded(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t group = 0;
  unsigned bits = 0;
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
      fail(place(array, index) + " is not there");
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
    fail(std::string(what) + " is no whole number");
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
        if (!content) fail(place("buffers", index) + " is no base64");
        decoded[index] = std::move(*content);
      }
      bytes = decoded[index];
    } else if (index != 0 || binary.empty()) {
      fail(place("buffers", index) + " has no bytes");
    }
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
    if (accessor.contains("sparse")) fail(name + " is sparse, which is not read");
    const auto kind = accessor.find("type");
    if (kind == accessor.end() || *kind != type) fail(name + " is no " + std::string(type));
    Numbers found;
    found.component = needed(accessor, "componentType");
    found.count = needed(accessor, "count");
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
    if (found.stride < size || found.stride > 252) fail(name + ": byteStride can't be");
    const bool is_inside =
        found.count == 0 || (offset <= length && size <= length - offset &&
                             found.count - 1 <= (length - offset - size) / found.stride);
    if (!is_inside) fail(name + " is not within its bufferView");
    found.first = bytes.data() + offset;
    return found;
  }

  std::uint64_t component_size(std::uint64_t component, const std::string& name) const {
    if (component == 5121) return 1;
    if (component == 5123) return 2;
    if (component == 5125 || component == 5126) return 4;
    fail(name + ": componentType " + std::to_string(component) + " is not read");
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
  if (mode == 4) {
    list = corners;
    list.resize(corners.size() / 3 * 3);
    return list;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t odd = i % 2;
    const std::array<std::uint64_t, 3> triangle =
        mode == 5 ? std::array{corners[i], corners[i + 1 + odd], corners[i + 2 - odd]}
                  : std::array{corners[0], corners[i + 1], corners[i + 2]};
    list.insert(list.end(), triangle.begin(), triangle.end());
  }
  return list;
}

/// Writes the plain file: a .glb whose every primitive has positions and indices of its own.
struct GlbWriter {
  Gltf& from;
  std::uint64_t most_triangles;
  std::uint64_t triangles = 0;
  std::string buffer = {};
  json out = {{"asset", {{"version", "2.0"}}}};
  std::vector<std::optional<std::uint64_t>> new_mesh = {};  ///< of a mesh with triangles

  std::uint64_t add_accessor(std::uint64_t count, const char* type, int component,
                             std::size_t begin) {
    out["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", buffer.size() - begin}});
    out["accessors"].push_back({{"bufferView", out["bufferViews"].size() - 1},
                                {"componentType", component},
                                {"count", count},
                                {"type", type}});
    return out["accessors"].size() - 1;
  }

  void add_primitive(const json& primitive, const std::string& name, json& to) {
    if (!primitive.is_object()) from.fail(name + ": a primitive is no object");
    const std::uint64_t mode = from.whole(primitive, "mode").value_or(4);
    if (mode < 4) return;  // points and lines
    if (mode > 6) from.fail(name + ": mode " + std::to_string(mode) + " is not known");
    if (primitive.contains("extensions") &&
        primitive["extensions"].contains("KHR_draco_mesh_compression")) {
      from.fail(name + " is compressed by Draco, which is not read; export it uncompressed");
    }
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object()) return;
    const auto position = from.whole(*attributes, "POSITION");
    if (!position) return;
    const std::vector<Eigen::Vector3f> vertices = from.positions(*position);
    std::vector<std::uint64_t> corners(vertices.size());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = i;
    if (const auto index = from.whole(primitive, "indices")) corners = from.indices(*index);
    corners = triangle_list(corners, mode);
    if (corners.empty()) return;
    triangles += corners.size() / 3;
    if (triangles > most_triangles) fail_triangles(from.file, most_triangles);
    std::vector<std::uint64_t> used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (used.back() >= vertices.size()) from.fail(name + ": an index names no vertex");
    json plain;
    std::size_t begin = buffer.size();
    for (const std::uint64_t i : used) {
      buffer.append(reinterpret_cast<const char*>(vertices[i].data()), 12);
    }
    plain["attributes"]["POSITION"] = add_accessor(used.size(), "VEC3", 5126, begin);
    begin = buffer.size();
    for (const std::uint64_t corner : corners) {
      const auto index = static_cast<std::uint32_t>(
          std::lower_bound(used.begin(), used.end(), corner) - used.begin());
      buffer.append(reinterpret_cast<const char*>(&index), 4);
    }
    plain["indices"] = add_accessor(corners.size(), "SCALAR", 5125, begin);
    if (const auto material = from.whole(primitive, "material")) {
      from.element("materials", *material);
      plain["material"] = *material;
    }
    to.push_back(std::move(plain));
  }

  /// Assimp makes up names where there are none.
  static std::string name_of(const json& object) {
    const auto name = object.find("name");
    const bool is_text = name != object.end() && name->is_string();
    const std::string plain = is_text ? plain_name(name->get_ref<const std::string&>()) : "";
    return plain.empty() ? "mesh" : plain;
  }

  void add_meshes() {
    for (std::uint64_t i = 0; i < from.count("materials"); ++i) {
      out["materials"].push_back({{"name", name_of(from.element("materials", i))}});
    }
    for (std::uint64_t i = 0; i < from.count("meshes"); ++i) {
      const json& mesh = from.element("meshes", i);
      json primitives = json::array();
      const auto found = mesh.find("primitives");
      if (found != mesh.end() && found->is_array()) {
        for (const json& primitive : *found) {
          add_primitive(primitive, place("meshes", i), primitives);
        }
      }
      new_mesh.emplace_back();
      if (primitives.empty()) continue;
      out["meshes"].push_back({{"name", name_of(mesh)}, {"primitives", std::move(primitives)}});
      new_mesh.back() = out["meshes"].size() - 1;
    }
  }

  /// Copies the numbers of a node's transform.
  void copy_numbers(const json& node, const char* key, std::size_t count, json& to) const {
    const auto found = node.find(key);
    if (found == node.end()) return;
    bool is_right = found->is_array() && found->size() == count;
    for (std::size_t k = 0; is_right && k < count; ++k) {
      const json& number = (*found)[k];
      is_right = number.is_number() && std::isfinite(number.get<float>());
      if (is_right) to[key].push_back(number.get<float>());
    }
    if (!is_right) from.fail(std::string("a node's ") + key + " is wrong");
  }

  /// Adds the node and those below; each may be there once, so that they are a tree.
  void add_node(std::uint64_t index, int depth, std::vector<bool>& is_there) {
    constexpr int kMostDepth = 200;
    const json& node = from.element("nodes", index);
    const std::string name = place("nodes", index);
    if (is_there[index]) from.fail(name + " is below two others or below itself");
    if (depth > kMostDepth) from.fail("its nodes are nested deeper than 200");
    is_there[index] = true;
    json plain = {{"name", name_of(node)}};
    copy_numbers(node, "matrix", 16, plain);
    copy_numbers(node, "translation", 3, plain);
    copy_numbers(node, "rotation", 4, plain);
    copy_numbers(node, "scale", 3, plain);
    if (const auto mesh = from.whole(node, "mesh")) {
      from.element("meshes", *mesh);
      if (new_mesh[*mesh]) plain["mesh"] = *new_mesh[*mesh];
    }
    const auto children = node.find("children");
    if (children != node.end() && children->is_array()) {
      for (const json& child : *children) {
        const std::uint64_t below = from.whole_number(child, "a node's child");
        add_node(below, depth + 1, is_there);
        plain["children"].push_back(below);
      }
    }
    out["nodes"][index] = std::move(plain);
  }

  void add_scene() {
    const std::uint64_t nodes = from.count("nodes");
    out["nodes"] = json::array();
    for (std::uint64_t i = 0; i < nodes; ++i) out["nodes"].push_back(json::object());
    std::vector<bool> is_there(nodes, false);
    json roots = json::array();
    const json& scene = from.element("scenes", from.whole(from.root, "scene").value_or(0));
    const auto found = scene.find("nodes");
    if (found == scene.end() || !found->is_array() || found->empty()) {
      from.fail("its scene has no nodes");
    }
    for (const json& root : *found) {
      const std::uint64_t index = from.whole_number(root, "a scene's node");
      add_node(index, 0, is_there);
      roots.push_back(index);
    }
    out["scene"] = 0;
    out["scenes"] = json::array({{{"nodes", roots}}});
  }

  std::string glb() {
    constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31U;
    out["buffers"] = json::array({{{"byteLength", buffer.size()}}});
    std::string text = out.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    if (text.size() + buffer.size() > kMostBytes) from.fail("is too large");
    const auto word = [](std::uint64_t value) {
      const auto number = static_cast<std::uint32_t>(value);
      return std::string(reinterpret_cast<const char*>(&number), 4);
    };
    std::string bytes = "glTF" + word(2) + word(28 + text.size() + buffer.size());
    bytes += word(text.size()) + "JSON" + text;
    bytes += word(buffer.size()) + std::string("BIN\0", 4) + buffer;
    return bytes;
  }
};

/// Takes the chunks JSON and BIN out of a .glb file.
std::string_view take_chunks(std::string_view bytes, const std::string& file,
                             std::string_view& binary) {
  const auto word = [&](std::size_t at) { return load<std::uint32_t>(bytes.data() + at, false); };
  if (bytes.size() < 20) fail_file(file, "is truncated: a .glb file has 20 bytes at least");
  if (word(4) != 2) fail_file(file, "is glTF " + std::to_string(word(4)) + "; 2 is read");
  if (word(8) > bytes.size()) {
    fail_file(file, "is truncated: it promises " + std::to_string(word(8)) + " bytes and has " +
                        std::to_string(bytes.size()));
  }
  bytes = bytes.substr(0, word(8));
  std::string_view text;
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

PlainMesh plain_gltf(std::string_view bytes, const std::string& file,
                     std::uint64_t most_triangles) {
  Gltf gltf{.file = file, .root = {}, .binary = {}};
  if (bytes.starts_with("glTF")) bytes = take_chunks(bytes, file, gltf.binary);
  try {
    gltf.root = json::parse(bytes);
  } catch (const json::parse_error& error) {
    fail_file(file, "is no glTF: its JSON ends or is wrong at byte " + std::to_string(error.byte));
  } catch (const json::out_of_range&) {
    fail_file(file, "is no glTF: a number of its JSON is too large");
  }
  if (!gltf.root.is_object()) fail_file(file, "is no glTF: its JSON is no object");
  const auto asset = gltf.root.find("asset");
  const bool has_asset = asset != gltf.root.end() && asset->is_object();
  const auto version = has_asset ? asset->find("version") : gltf.root.end();
  if (!has_asset || version == asset->end() || !version->is_string() ||
      !version->get_ref<const std::string&>().starts_with("2.")) {
    fail_file(file, "is no glTF of version 2");
  }
  GlbWriter writer{gltf, most_triangles};
  writer.add_meshes();
  if (writer.triangles == 0) fail_file(file, "has no triangles");
  writer.add_scene();
  return {.name = "map.glb", .bytes = writer.glb()};
}

}  // namespace avoidbench
