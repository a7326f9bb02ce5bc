#include "world/plain_mesh.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "world/cloud_bytes.hpp"

namespace avoidbench {
namespace {

void add_number(double value, std::string& text) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.begin(), digits.end(), static_cast<float>(value)).ptr;
  text.append(digits.begin(), end);
}

void add_raw(const void* value, std::size_t size, std::string& bytes) {
  bytes.append(static_cast<const char*>(value), size);
}

/// The next three words as numbers that single precision has.
Eigen::Vector3d take_position(std::string_view& words, const std::string& file, int line) {
  Eigen::Vector3d position;
  for (double& value : position) {
    const std::string_view word = take_word(words);
    const auto number = number_in<double>(word);
    if (!number) {
      fail_file(file, word.empty() ? "too few numbers" : in_quotes(word) + " is no number", line);
    }
    if (!std::isfinite(static_cast<float>(*number))) {
      fail_file(file, "vertex: " + in_quotes(word) + " is not finite", line);
    }
    value = *number;
  }
  return position;
}

/// Reads OBJ line by line.
struct ObjReader {
  const std::string& file;
  std::uint64_t most_triangles;
  std::int64_t vertices = 0;
  std::uint64_t triangles = 0;
  PlainMesh plain = {.name = "map.obj", .bytes = {}};
  /// The lines o, g and usemtl since the last face: written only where a face follows.
  std::array<std::string, 3> pending = {};

  void add_vertex(std::string_view words, int line) {
    Eigen::Vector3d position = take_position(words, file, line);
    const std::string_view w = take_word(words);
    const bool has_w = !w.empty() && take_word(words).empty();  // more words are a color
    if (has_w && number_in<double>(w) != 1.0) fail_file(file, "a vertex's w is not 1", line);
    if (vertices == 0) plain.offset = offset_near(position);
    ++vertices;
    if (static_cast<std::uint64_t>(vertices) > 3 * most_triangles) {
      fail_vertices(file, most_triangles);
    }
    position -= plain.offset;
    plain.bytes += "v";
    for (const double value : position) add_number(value, plain.bytes += ' ');
    plain.bytes += '\n';
  }

  void add_face(std::string_view words, int line) {
    std::uint64_t corners = 0;
    for (std::string& line_before : pending) plain.bytes += std::exchange(line_before, {});
    plain.bytes += "f";
    for (auto word = take_word(words); !word.empty(); word = take_word(words)) {
      const auto number = number_in<std::int64_t>(word.substr(0, word.find('/')));
      if (!number) fail_file(file, in_quotes(word) + " is no corner of a face", line);
      if (*number == 0 || *number > vertices || *number < -vertices) {
        fail_file(file,
                  "the face names vertex " + std::to_string(*number) + "; up to here there are " +
                      std::to_string(vertices),
                  line);
      }
      plain.bytes += ' ' + std::to_string(*number > 0 ? *number : vertices + 1 + *number);
      ++corners;
    }
    if (corners > kMostCorners) fail_corners(file, line);
    if (corners < 3) fail_file(file, "a face of fewer than 3 corners", line);
    plain.bytes += '\n';
    triangles += corners - 2;
    if (triangles > most_triangles) fail_triangles(file, most_triangles);
  }

  void add_line(std::string_view words, int line) {
    const std::string_view key = take_word(words);
    if (key.empty() || key[0] == '#') return;
    if (words.ends_with('\\')) fail_file(file, "lines continued by \\ are not read", line);
    if (key == "v") add_vertex(words, line);
    if (key == "f") add_face(words, line);
    constexpr std::array<std::string_view, 3> kNamed{"o", "g", "usemtl"};
    for (std::size_t i = 0; i < kNamed.size(); ++i) {
      if (key != kNamed[i]) continue;
      const std::string name = plain_name(words.substr(std::min<std::size_t>(words.size(), 1)));
      pending[i] = std::string(key) + ' ' + (name.empty() ? "mesh" : name) + '\n';
    }
  }
};

/// Triangles gathered for a binary STL file.
struct StlWriter {
  const std::string& file;
  std::uint64_t most_triangles;
  std::uint32_t triangles = 0;
  std::string bytes = std::string(84, ' ');

  void add(const std::array<Eigen::Vector3f, 3>& corners) {
    if (triangles >= most_triangles) fail_triangles(file, most_triangles);
    ++triangles;
    bytes.append(12, '\0');  // the normal
    for (const Eigen::Vector3f& corner : corners) add_raw(corner.data(), 12, bytes);
    bytes.append(2, '\0');
  }

  PlainMesh done() {
    if (triangles == 0) fail_file(file, "has no triangles");
    std::memcpy(bytes.data() + 80, &triangles, 4);
    return {.name = "map.stl", .bytes = std::move(bytes)};
  }
};

PlainMesh plain_binary_stl(std::string_view bytes, StlWriter& writer) {
  bytes.remove_prefix(84);
  for (; bytes.size() >= 50; bytes.remove_prefix(50)) {
    std::array<Eigen::Vector3f, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) std::memcpy(corners[k].data(), &bytes[12 + 12 * k], 12);
    for (const Eigen::Vector3f& corner : corners) {
      if (corner.allFinite()) continue;
      fail_file(writer.file,
                "triangle " + std::to_string(writer.triangles + 1) + ": a vertex is not finite");
    }
    writer.add(corners);
  }
  return writer.done();
}

PlainMesh plain_ascii_stl(std::string_view bytes, StlWriter& writer) {
  const std::string& file = writer.file;
  LineCursor lines{bytes};
  std::array<Eigen::Vector3f, 3> corners;
  std::size_t corner = 0;
  bool is_open = false, has_ended = false;
  while (auto line = lines.next()) {
    const std::string_view key = take_word(*line);
    if (key == "vertex") {
      if (!is_open || corner >= 3) fail_file(file, "a vertex too many", lines.line);
      corners[corner++] = take_position(*line, file, lines.line).cast<float>();
    } else if (key == "facet") {
      if (is_open) fail_file(file, "the facet before does not end", lines.line);
      is_open = true;
      corner = 0;
    } else if (key == "endfacet") {
      if (!is_open || corner != 3) {
        fail_file(file, "a facet of " + std::to_string(corner) + " vertices", lines.line);
      }
      writer.add(corners);
      is_open = false;
    } else if (key != "solid" && key != "endsolid" && key != "outer" && key != "endloop" &&
               !key.empty()) {
      fail_file(file, in_quotes(key) + " is no word of an STL file", lines.line);
    }
    if (!key.empty()) has_ended = key == "endsolid";
  }
  if (!has_ended) fail_file(file, "is truncated: it does not end by 'endsolid'", lines.line);
  return writer.done();
}

}  // namespace

Eigen::Vector3d offset_near(const Eigen::Vector3d& vertex) {
  constexpr double kNear = 4096.0, kLimit = 1e12;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double value = vertex[axis];
    if (std::abs(value) > kNear && std::abs(value) < kLimit) offset[axis] = std::floor(value);
  }
  return offset;
}

std::string plain_name(std::string_view name) {
  constexpr std::size_t kMost = 100;
  std::string plain;
  for (const char c : name.substr(0, kMost)) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    plain += is_letter || (c >= '0' && c <= '9') || c == '.' ? c : '_';
  }
  return plain;
}

void fail_corners(const std::string& file, int line) {
  fail_file(file,
            "a face of more than " + std::to_string(kMostCorners) +
                " corners; cut it to triangles before",
            line);
}

void fail_triangles(const std::string& file, std::uint64_t most_triangles) {
  fail_file(file,
            "has more than " + std::to_string(most_triangles) + " triangles; decimate it before");
}

void fail_vertices(const std::string& file, std::uint64_t most_triangles) {
  fail_file(file, "has more than " + std::to_string(3 * most_triangles) +
                      " vertices, three for each of the most triangles; decimate it before");
}

PlainMesh plain_obj(std::string_view bytes, const std::string& file, std::uint64_t most_triangles) {
  ObjReader reader{file, most_triangles};
  LineCursor lines{bytes};
  while (const auto line = lines.next()) reader.add_line(*line, lines.line);
  if (reader.triangles == 0) fail_file(file, "has no triangles");
  return std::move(reader.plain);
}

PlainMesh plain_stl(std::string_view bytes, const std::string& file, std::uint64_t most_triangles) {
  StlWriter writer{file, most_triangles};
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  std::uint64_t promised = 0;
  if (bytes.size() >= kHeader) {
    promised = load<std::uint32_t>(bytes.data() + 80, false);
    if (bytes.size() == kHeader + kTriangle * promised) return plain_binary_stl(bytes, writer);
  }
  std::string_view start = bytes.substr(0, 100);
  if (take_word(start) == "solid") return plain_ascii_stl(bytes, writer);
  if (bytes.size() < kHeader) fail_file(file, "is truncated: an STL file has 84 bytes at least");
  fail_file(file, "is truncated or no STL: it promises " + std::to_string(promised) +
                      " triangles, " + std::to_string(kHeader + kTriangle * promised) +
                      " bytes, and has " + std::to_string(bytes.size()));
}

}  // namespace avoidbench
