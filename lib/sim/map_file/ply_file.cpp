#include <algorithm>
#include <array>

#include "base/poll.hpp"
#include "base/words.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/mesh_readers.hpp"
#include "map_file/point_cloud_file.hpp"
#include "map_file/polygon.hpp"

namespace avoidbench {
namespace {

enum class Encoding { ascii, little_endian, big_endian };

struct Property {
  std::string name;
  NumberType type = NumberType::f32;
  bool is_list = false;
  NumberType count_type = NumberType::u8;  ///< of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

std::optional<NumberType> type_of(std::string_view word) {
  struct Name {
    std::string_view text;
    NumberType type;
  };
  // Those of the format's first description, and those with their bits, which writers use as well.
  constexpr std::array<Name, 18> kNames{{{"char", NumberType::i8},
                                         {"int8", NumberType::i8},
                                         {"uchar", NumberType::u8},
                                         {"uint8", NumberType::u8},
                                         {"short", NumberType::i16},
                                         {"int16", NumberType::i16},
                                         {"ushort", NumberType::u16},
                                         {"uint16", NumberType::u16},
                                         {"int", NumberType::i32},
                                         {"int32", NumberType::i32},
                                         {"uint", NumberType::u32},
                                         {"uint32", NumberType::u32},
                                         {"float", NumberType::f32},
                                         {"float32", NumberType::f32},
                                         {"double", NumberType::f64},
                                         {"float64", NumberType::f64},
                                         {"int64", NumberType::i64},
                                         {"uint64", NumberType::u64}}};
  for (const Name& name : kNames) {
    if (name.text == word) return name.type;
  }
  return std::nullopt;
}

NumberType known_type(std::string_view word, const std::string& file, int line) {
  const auto type = type_of(word);
  if (!type) fail_file(file, in_quotes(word) + " is not a type of a PLY property", line);
  return *type;
}

void add_property(const std::vector<std::string_view>& words, PlyHeader& header,
                  const std::string& file, int line) {
  if (header.elements.empty()) fail_file(file, "a property before the first element", line);
  Property property;
  property.is_list = words.size() == 5 && words[1] == "list";
  if (property.is_list) {
    property.count_type = known_type(words[2], file, line);
    if (property.count_type == NumberType::f32 || property.count_type == NumberType::f64) {
      fail_file(file, "a list's count is not a whole number", line);
    }
    property.type = known_type(words[3], file, line);
  } else if (words.size() == 3) {
    property.type = known_type(words[1], file, line);
  } else {
    fail_file(file, "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'", line);
  }
  property.name = words.back();
  header.elements.back().properties.push_back(std::move(property));
}

void read_format(const std::vector<std::string_view>& words, PlyHeader& header,
                 const std::string& file, int line) {
  const std::string_view name = words.size() == 3 ? words[1] : "";
  if (name == "ascii") {
    header.encoding = Encoding::ascii;
  } else if (name == "binary_little_endian") {
    header.encoding = Encoding::little_endian;
  } else if (name == "binary_big_endian") {
    header.encoding = Encoding::big_endian;
  } else {
    fail_file(file, "expected 'format ascii|binary_little_endian|binary_big_endian 1.0'", line);
  }
}

PlyHeader read_ply_header(LineCursor& lines, const std::string& file) {
  constexpr int kMostLines = 10'000;
  PlyHeader header;
  bool has_format = false;
  lines.next();  // "ply", as was seen before
  while (const auto line = lines.next()) {
    const std::vector<std::string_view> words = words_of(*line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") {
      if (!has_format) fail_file(file, "the header lacks 'format'", lines.line);
      return header;
    }
    if (words[0] == "format") {
      read_format(words, header, file, lines.line);
      has_format = true;
    } else if (words[0] == "element") {
      const auto count = words.size() == 3 ? number_in<std::uint64_t>(words[2]) : std::nullopt;
      if (!count) fail_file(file, "expected 'element NAME COUNT'", lines.line);
      header.elements.push_back({std::string(words[1]), *count, {}});
    } else if (words[0] == "property") {
      add_property(words, header, file, lines.line);
    } else {
      fail_file(file, in_quotes(words[0]) + " is not a word of a PLY header", lines.line);
    }
    // Binary data after a header that does not end may look like lines for long.
    if (lines.line > kMostLines) break;
  }
  fail_file(file, "the header does not end ('end_header')", lines.line);
}

/// Where x, y and z are among the properties.
std::array<std::size_t, 3> xyz_of(const Element& vertex, const std::string& file) {
  std::array<std::size_t, 3> found{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto property =
        std::find_if(vertex.properties.begin(), vertex.properties.end(),
                     [&](const Property& p) { return p.name == name && !p.is_list; });
    if (property == vertex.properties.end()) {
      fail_file(file, "the element vertex lacks the property " + name);
    }
    found[axis] = static_cast<std::size_t>(property - vertex.properties.begin());
  }
  return found;
}

[[noreturn]] void fail_short(const std::string& file, const Element& element, std::uint64_t found,
                             int line = 0) {
  fail_file(file,
            "is truncated: the header promises " + std::to_string(element.count) + " of " +
                in_quotes(element.name) + ", there are " + std::to_string(found),
            line);
}

/// Bytes of an element without lists; nothing where it has one.
std::optional<std::size_t> fixed_size(const Element& element) {
  std::size_t size = 0;
  for (const Property& property : element.properties) {
    if (property.is_list) return std::nullopt;
    size += size_of(property.type);
  }
  return size;
}

/// Where a property's numbers stand, and how many they are.
struct Taken {
  const char* bytes;
  std::size_t count;
};

/// Takes one binary element off `rest`; where its properties are is put in `taken`. False where the
/// bytes end before it.
bool take_binary(const Element& element, bool is_big_endian, std::string_view& rest,
                 std::vector<Taken>& taken) {
  taken.clear();
  for (const Property& property : element.properties) {
    std::size_t count = 1;
    if (property.is_list) {
      const std::size_t count_size = size_of(property.count_type);
      if (rest.size() < count_size) return false;
      const double listed = load_number(rest.data(), property.count_type, is_big_endian);
      rest.remove_prefix(count_size);
      // A number takes one byte at least: a larger count is beyond the end.
      if (!(listed >= 0.0 && listed <= static_cast<double>(rest.size()))) return false;
      count = static_cast<std::size_t>(listed);
    }
    if (rest.size() / size_of(property.type) < count) return false;
    taken.push_back({rest.data(), count});
    rest.remove_prefix(count * size_of(property.type));
  }
  return true;
}

void skip_binary(const Element& element, bool is_big_endian, std::string_view& rest,
                 const std::string& file) {
  // Without lists it is one step, however many there are.
  if (const auto size = fixed_size(element)) {
    // An element without properties has no bytes: else it would be divided by.
    if (*size == 0) return;
    if (rest.size() / *size < element.count) fail_short(file, element, rest.size() / *size);
    rest.remove_prefix(*size * element.count);
    return;
  }
  std::vector<Taken> taken;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (!take_binary(element, is_big_endian, rest, taken)) fail_short(file, element, i);
  }
}

FilePoints binary_points(const Element& vertex, bool is_big_endian, std::string_view rest,
                         const std::string& file) {
  const std::array<std::size_t, 3> xyz = xyz_of(vertex, file);
  // Told at once where it can be; with lists it shows on the way.
  if (const auto size = fixed_size(vertex); size && rest.size() / *size < vertex.count) {
    fail_short(file, vertex, rest.size() / *size);
  }
  FilePoints points;
  std::vector<Taken> taken;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    poll_caller();
    if (!take_binary(vertex, is_big_endian, rest, taken)) fail_short(file, vertex, i);
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[static_cast<Eigen::Index>(axis)] =
          load_number(taken[xyz[axis]].bytes, vertex.properties[xyz[axis]].type, is_big_endian);
    }
    add_if_finite(point, points);
  }
  return points;
}

/// One point a line; properties after z are not looked at.
FilePoints ascii_points(const Element& vertex, LineCursor& lines, const std::string& file) {
  const std::array<std::size_t, 3> xyz = xyz_of(vertex, file);
  const std::size_t last = *std::max_element(xyz.begin(), xyz.end());
  for (std::size_t i = 0; i < last; ++i) {
    // Behind a list the place of a coordinate differs from line to line.
    if (vertex.properties[i].is_list) fail_file(file, "a list comes before x, y and z");
  }
  FilePoints points;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    poll_caller();
    auto line = lines.next();
    if (!line) fail_short(file, vertex, i, lines.line);
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k <= last; ++k) {
      const std::string_view word = take_word(*line);
      const auto number = number_in<double>(word);
      if (!number) {
        const std::string what =
            word.empty() ? "too few numbers" : in_quotes(word) + " is not a number";
        fail_file(file, what, lines.line);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (xyz[axis] == k) point[static_cast<Eigen::Index>(axis)] = *number;
      }
    }
    add_if_finite(point, points);
  }
  return points;
}

/// Calls `act(property, k, value)` for each number of an element: the k-th of the property's list.
/// False where the bytes end before the element's end.
template <class Act>
bool for_each_number(const PlyHeader& header, const Element& element, LineCursor& lines,
                     const std::string& file, Act&& act) {
  if (header.encoding != Encoding::ascii) {
    const bool is_big_endian = header.encoding == Encoding::big_endian;
    std::vector<Taken> taken;
    if (!take_binary(element, is_big_endian, lines.rest, taken)) return false;
    for (std::size_t p = 0; p < taken.size(); ++p) {
      const NumberType type = element.properties[p].type;
      for (std::size_t k = 0; k < taken[p].count; ++k) {
        act(p, k, load_number(taken[p].bytes + k * size_of(type), type, is_big_endian));
      }
    }
    return true;
  }
  auto line = lines.next();
  if (!line) return false;
  const auto take_number = [&] {
    const std::string_view word = take_word(*line);
    const auto number = number_in<double>(word);
    if (number) return *number;
    fail_file(file, word.empty() ? "too few numbers" : in_quotes(word) + " is not a number",
              lines.line);
  };
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    double count = 1.0;
    if (element.properties[p].is_list) {
      count = take_number();
      // A number takes one letter at least.
      if (!(count >= 0.0 && count <= static_cast<double>(line->size()))) {
        fail_file(file, "too few numbers", lines.line);
      }
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) act(p, k, take_number());
  }
  return true;
}

/// Gathers the elements of a mesh.
struct MeshReader {
  const MeshSource& source;
  const PlyHeader& header;
  LineCursor lines;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> vertices = {};  ///< from the offset
  MeshPart part = {.kind = obstacle_kind(""), .vertices = {}, .triangles = {}, .materials = {}};
  std::uint64_t triangle_count = 0;
  const char* begin = lines.rest.data();  ///< of the element that is read
  std::vector<std::uint32_t> face = {};
  std::vector<Eigen::Vector3f> corners = {};
  std::vector<CornerTriple> cuts = {};

  bool is_text() const { return header.encoding == Encoding::ascii; }
  int line() const { return is_text() ? lines.line : 0; }

  /// "face 7", with its place in binary files, which have no lines.
  std::string name_of(const char* element, std::uint64_t index) const {
    const std::string name = std::string(element) + ' ' + std::to_string(index);
    return is_text() ? name : name + " at byte " + std::to_string(begin - source.bytes.data());
  }

  /// Calls `act(property, k, value)` for each number of the element's next one, the index-th.
  template <class Act>
  void take(const Element& element, std::uint64_t index, Act&& act) {
    poll_caller();
    begin = lines.rest.data();
    if (for_each_number(header, element, lines, source.file, act)) return;
    fail_short(source.file, element, index, line());
  }

  void add_vertices(const Element& element) {
    const std::array<std::size_t, 3> xyz = xyz_of(element, source.file);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Eigen::Vector3d position;
      take(element, i, [&](std::size_t property, std::size_t, double value) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (xyz[axis] == property) position[static_cast<Eigen::Index>(axis)] = value;
        }
      });
      if (!position.cast<float>().allFinite()) {
        fail_file(source.file, name_of("vertex", i) + " is not finite", line());
      }
      if (i == 0) offset = offset_near(position);
      vertices.emplace_back((position - offset).cast<float>());
      // What single precision kept of it, and no more: digests depend on it.
      part.vertices.push_back(vertices.back().cast<double>() + offset);
    }
  }

  void add_face(std::uint64_t index) {
    // Points and lines that some writers leave as faces.
    if (face.size() < 3) return;
    if (face.size() > kMostCorners) fail_corners(source.file, line());
    // So many triangles it will be cut into.
    triangle_count += face.size() - 2;
    if (triangle_count > source.most_triangles) fail_triangles(source);
    corners.clear();
    for (const std::uint32_t vertex : face) corners.push_back(vertices[vertex]);
    if (!cut_polygon(corners, cuts)) fail_crossing(source.file, name_of("face", index), line());
    for (const auto& [a, b, c] : cuts) {
      part.triangles.push_back({face[a], face[b], face[c]});
      part.materials.push_back(source.fallback);
    }
  }

  void add_faces(const Element& element) {
    std::size_t list = 0;
    const auto is_list = [&](const Property& p) {
      return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    while (list < element.properties.size() && !is_list(element.properties[list])) ++list;
    if (list == element.properties.size()) {
      fail_file(source.file, "the element face lacks the list vertex_indices");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      face.clear();
      take(element, i, [&](std::size_t property, std::size_t, double value) {
        if (property != list) return;
        // NaN is refused by this too.
        if (!(value >= 0.0 && value < static_cast<double>(vertices.size()))) {
          fail_file(source.file, name_of("face", i) + " names a vertex that does not exist",
                    line());
        }
        face.push_back(static_cast<std::uint32_t>(value));
      });
      add_face(i);
    }
  }

  void skip(const Element& element) {
    // In text even an element of nothing has its lines.
    if (element.properties.empty() && !is_text()) return;
    const auto ignore = [](std::size_t, std::size_t, double) {};
    for (std::uint64_t i = 0; i < element.count; ++i) take(element, i, ignore);
  }
};

/// The one element of this name; null where there is none.
const Element* the_element(const PlyHeader& header, std::string_view name,
                           const std::string& file) {
  const Element* found = nullptr;
  for (const Element& element : header.elements) {
    if (element.name != name) continue;
    if (found != nullptr) fail_file(file, "has two elements " + in_quotes(name));
    found = &element;
  }
  return found;
}

}  // namespace

FilePoints parse_ply_points(std::string_view bytes, const std::string& file) {
  LineCursor lines{bytes};
  const PlyHeader header = read_ply_header(lines, file);
  const Element* face = the_element(header, "face", file);
  if (face != nullptr && face->count > 0) {
    fail_file(file, "is a mesh of " + counted(face->count, "face") +
                        ", not a cloud of points: use generator: mesh");
  }
  const bool is_big_endian = header.encoding == Encoding::big_endian;
  // Elements stand in the order of the header: what comes before the vertices has to be gone
  // through.
  for (const Element& element : header.elements) {
    const bool is_vertex = element.name == "vertex";
    if (header.encoding != Encoding::ascii) {
      if (is_vertex) return binary_points(element, is_big_endian, lines.rest, file);
      skip_binary(element, is_big_endian, lines.rest, file);
      continue;
    }
    if (is_vertex) return ascii_points(element, lines, file);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!lines.next()) fail_short(file, element, i, lines.line);
    }
  }
  fail_file(file, "the header lacks 'element vertex'");
}

std::vector<MeshPart> parse_ply_mesh(const MeshSource& source) {
  const std::string& file = source.file;
  LineCursor lines{source.bytes};
  if (lines.next() != "ply") fail_file(file, "does not begin as a PLY file ('ply')", 1);
  // From the beginning: the header's reader counts lines for its messages.
  lines = {source.bytes};
  const PlyHeader header = read_ply_header(lines, file);
  const Element* vertex = the_element(header, "vertex", file);
  const Element* face = the_element(header, "face", file);
  if (vertex == nullptr) fail_file(file, "the header lacks 'element vertex'");
  if (face == nullptr || face->count == 0) {
    fail_file(file, "has no triangles; for a cloud of points use generator: point_cloud");
  }
  // Each triangle names three: more are of no use to any.
  if (vertex->count > 3 * source.most_triangles) fail_vertices(source);
  MeshReader reader{.source = source, .header = header, .lines = lines};
  std::optional<LineCursor> faces;  // where they begin, if before the vertices
  for (const Element& element : header.elements) {
    if (&element == vertex) {
      reader.add_vertices(element);
    } else if (&element == face && vertex < face) {
      // Faces name vertices by number: those that stand first are read in a second go.
      reader.add_faces(element);
    } else {
      if (&element == face) faces = reader.lines;
      reader.skip(element);
    }
  }
  if (faces) {
    reader.lines = *faces;
    reader.add_faces(*face);
  }
  return {std::move(reader.part)};
}

}  // namespace avoidbench
