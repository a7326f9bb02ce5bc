#include <algorithm>
#include <array>

#include "base/poll.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/lzf.hpp"
#include "map_file/point_cloud_file.hpp"

namespace avoidbench {
namespace {

struct Field {
  std::string name;
  std::size_t size = 4;  ///< bytes of one number
  char type = 'F';       ///< F, I or U
  std::size_t count = 1;
};

struct PcdHeader {
  std::vector<Field> fields;
  std::uint64_t points = 0;
  std::string data;  ///< ascii, binary, binary_compressed
};

/// A field of the header by its place: where its numbers begin in a point, and what they are.
struct Place {
  std::size_t word = 0;  ///< of an ascii line
  std::size_t byte = 0;  ///< of a binary point
  NumberType type = NumberType::f32;
};

constexpr std::size_t kMostCount = 1'000'000;  // numbers in a field

NumberType type_of(const Field& field, const std::string& file) {
  const auto is = [&](char type, std::size_t size) {
    return field.type == type && field.size == size;
  };
  if (is('F', 4)) return NumberType::f32;
  if (is('F', 8)) return NumberType::f64;
  if (is('I', 1)) return NumberType::i8;
  if (is('I', 2)) return NumberType::i16;
  if (is('I', 4)) return NumberType::i32;
  if (is('I', 8)) return NumberType::i64;
  if (is('U', 1)) return NumberType::u8;
  if (is('U', 2)) return NumberType::u16;
  if (is('U', 4)) return NumberType::u32;
  if (is('U', 8)) return NumberType::u64;
  fail_file(file, "the field " + in_quotes(field.name) + " has no known TYPE and SIZE");
}

/// A line of one word a field: SIZE, TYPE or COUNT.
void read_column(const std::vector<std::string_view>& words, PcdHeader& header,
                 const std::string& file, int line) {
  if (words.size() != header.fields.size() + 1) {
    fail_file(file,
              std::string(words[0]) + " has " + std::to_string(words.size() - 1) +
                  " entries for the " + std::to_string(header.fields.size()) + " of FIELDS",
              line);
  }
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    Field& field = header.fields[i];
    const std::string_view word = words[i + 1];
    if (words[0] == "TYPE") {
      // No type of that name: refused where x, y or z has it.
      field.type = word.size() == 1 ? word[0] : '?';
      continue;
    }
    const auto number = number_in<std::uint64_t>(word);
    const bool is_size = words[0] == "SIZE";
    // So that sizes of points don't overflow.
    if (!number || *number > (is_size ? 8 : kMostCount) || *number == 0) {
      fail_file(file, std::string(words[0]) + ": " + in_quotes(word) + " can't be", line);
    }
    (is_size ? field.size : field.count) = static_cast<std::size_t>(*number);
  }
}

std::uint64_t whole_number(const std::vector<std::string_view>& words, const std::string& file,
                           int line) {
  const auto number = words.size() == 2 ? number_in<std::uint64_t>(words[1]) : std::nullopt;
  if (!number) fail_file(file, "expected " + in_quotes(words[0]) + " and one whole number", line);
  return *number;
}

PcdHeader read_pcd_header(LineCursor& lines, const std::string& file) {
  constexpr int kMostLines = 10'000;
  PcdHeader header;
  std::optional<std::uint64_t> points, width, height;
  while (const auto line = lines.next()) {
    const std::vector<std::string_view> words = words_of(*line);
    // Binary data after a header without DATA may look like lines for long.
    if (lines.line > kMostLines) break;
    if (words.empty() || words[0].starts_with('#')) continue;
    // Both are passed over: points stay in the file's own frame.
    if (words[0] == "VERSION" || words[0] == "VIEWPOINT") {
    } else if (words[0] == "FIELDS") {
      header.fields.clear();
      for (std::size_t i = 1; i < words.size(); ++i)
        header.fields.push_back({std::string(words[i])});
    } else if (words[0] == "SIZE" || words[0] == "TYPE" || words[0] == "COUNT") {
      read_column(words, header, file, lines.line);
    } else if (words[0] == "WIDTH") {
      width = whole_number(words, file, lines.line);
    } else if (words[0] == "HEIGHT") {
      height = whole_number(words, file, lines.line);
    } else if (words[0] == "POINTS") {
      points = whole_number(words, file, lines.line);
    } else if (words[0] == "DATA") {
      header.data = words.size() == 2 ? words[1] : "";
      // POINTS is their product, and may be left out.
      // Clouds without rows have a HEIGHT of 1 or none.
      if (!points && width && *width > 0 && height.value_or(1) <= UINT64_MAX / *width) {
        points = *width * height.value_or(1);
      }
      if (!points) fail_file(file, "the header lacks POINTS", lines.line);
      header.points = *points;
      return header;
    } else {
      fail_file(file, in_quotes(words[0]) + " is not a word of a PCD header", lines.line);
    }
  }
  fail_file(file, "the header does not end ('DATA ascii|binary|binary_compressed')", lines.line);
}

/// x, y and z may stand anywhere among the fields, and have any type.
std::array<Place, 3> xyz_of(const PcdHeader& header, const std::string& file) {
  std::array<Place, 3> places{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    Place place;
    bool is_found = false;
    for (const Field& field : header.fields) {
      is_found = field.name == name;
      if (is_found) place.type = type_of(field, file);
      if (is_found) break;
      place.word += field.count;
      place.byte += field.count * field.size;
    }
    if (!is_found) fail_file(file, "FIELDS lacks " + name);
    places[axis] = place;
  }
  return places;
}

std::size_t point_size(const PcdHeader& header) {
  std::size_t size = 0;
  for (const Field& field : header.fields) size += field.count * field.size;
  return size;
}

[[noreturn]] void fail_short(const std::string& file, const PcdHeader& header, std::uint64_t found,
                             int line = 0) {
  fail_file(file,
            "is truncated: the header promises " + std::to_string(header.points) +
                " points, there are " + std::to_string(found),
            line);
}

FilePoints ascii_points(const PcdHeader& header, LineCursor& lines, const std::string& file) {
  const std::array<Place, 3> xyz = xyz_of(header, file);
  // What stands behind the last coordinate is not looked at.
  const std::size_t last = std::max({xyz[0].word, xyz[1].word, xyz[2].word});
  FilePoints points;
  for (std::uint64_t i = 0; i < header.points;) {
    poll_caller();
    auto line = lines.next();
    if (!line) fail_short(file, header, i, lines.line);
    std::string_view word = take_word(*line);
    if (word.empty()) continue;  // an empty line is no point
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k <= last; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (xyz[axis].word != k) continue;
        const auto number = number_in<double>(word);
        if (!number) {
          fail_file(file, word.empty() ? "too few numbers" : in_quotes(word) + " is not a number",
                    lines.line);
        }
        point[static_cast<Eigen::Index>(axis)] = *number;
      }
      if (word.empty()) fail_file(file, "too few numbers", lines.line);
      word = take_word(*line);
    }
    // NaN marks a pixel without a return in clouds of images: it is no point.
    add_if_finite(point, points);
    ++i;
  }
  return points;
}

/// Points whose numbers stand at base + index · stride.
struct Column {
  const char* base = nullptr;
  std::size_t stride = 0;
  NumberType type = NumberType::f32;
};

FilePoints column_points(const std::array<Column, 3>& columns, std::uint64_t count) {
  FilePoints points;
  // The count was held against the bytes before.
  points.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    poll_caller();
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Column& column = columns[axis];
      point[static_cast<Eigen::Index>(axis)] =
          load_number(column.base + i * column.stride, column.type, false);
    }
    add_if_finite(point, points);
  }
  return points;
}

FilePoints binary_points(const PcdHeader& header, std::string_view rest, const std::string& file) {
  const std::size_t size = point_size(header);
  const std::array<Place, 3> xyz = xyz_of(header, file);
  if (rest.size() / size < header.points) fail_short(file, header, rest.size() / size);
  std::array<Column, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns[axis] = {rest.data() + xyz[axis].byte, size, xyz[axis].type};
  }
  return column_points(columns, header.points);
}

/// Two 32-bit sizes, then an LZF stream of each field's numbers for all points, field by field.
FilePoints compressed_points(const PcdHeader& header, std::string_view rest,
                             const std::string& file) {
  if (rest.size() < 8) fail_file(file, "is truncated before its compressed points");
  const std::size_t compressed_size = load<std::uint32_t>(rest.data(), false);
  const std::size_t size = load<std::uint32_t>(rest.data() + 4, false);
  rest.remove_prefix(8);
  if (rest.size() < compressed_size) {
    fail_file(file, "is truncated: the compressed points are " + std::to_string(compressed_size) +
                        " bytes, there are " + std::to_string(rest.size()));
  }
  const std::array<Place, 3> xyz = xyz_of(header, file);
  const std::size_t stride = point_size(header);
  // No stream is that good: the size is wrong, and nothing is allocated for it.
  if (size / stride < header.points || size > kMostLzfRatio * compressed_size) {
    fail_file(file, "its compressed points can't be those the header promises");
  }
  const auto bytes = lzf_decompressed(rest.substr(0, compressed_size), size);
  if (!bytes) fail_file(file, "its compressed points are damaged");
  std::array<Column, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The first of its name, as xyz_of() takes it.
    std::size_t number_size = 0;
    for (const Field& field : header.fields) {
      if (field.name == std::string(1, "xyz"[axis])) {
        number_size = field.count * field.size;
        break;
      }
    }
    // A field's numbers stand together for all points, behind those of the fields before it.
    columns[axis] = {bytes->data() + xyz[axis].byte * header.points, number_size, xyz[axis].type};
  }
  return column_points(columns, header.points);
}

}  // namespace

FilePoints parse_pcd_points(std::string_view bytes, const std::string& file) {
  LineCursor lines{bytes};
  const PcdHeader header = read_pcd_header(lines, file);
  if (header.data == "ascii") return ascii_points(header, lines, file);
  if (header.data == "binary") return binary_points(header, lines.rest, file);
  if (header.data == "binary_compressed") return compressed_points(header, lines.rest, file);
  fail_file(file,
            "DATA " + in_quotes(header.data) + " is not one of ascii, binary, binary_compressed",
            lines.line);
}

}  // namespace avoidbench
