#include <algorithm>
#include <array>

#include "base/poll.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/point_cloud_file.hpp"

// LAS 1.2 to 1.4 as the ASPRS describes it: a header, records of other things, and points of equal
// size, all little-endian.
namespace avoidbench {
namespace {

constexpr std::size_t kSmallestHeader = 227;  // of LAS 1.2; later ones begin the same way
constexpr std::size_t kPiece = std::size_t{1} << 20U;

/// Bytes of a point of each format; more may follow in each.
constexpr std::array<std::size_t, 11> kPointSizes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

struct LasHeader {
  unsigned format = 0;  ///< of the points
  std::size_t point_size = 0;
  std::uint64_t points_begin = 0, points = 0;
  std::uint32_t records = 0;  ///< before the points
  std::array<double, 3> scale{}, offset{};
};

/// A file that is read from its first byte to its last.
struct Stream {
  const ByteReader& read;
  std::uint64_t at = 0;

  bool fill(std::span<char> bytes) {
    const std::size_t count = read(bytes);
    at += count;
    return count == bytes.size();
  }

  bool skip_to(std::uint64_t end) {
    std::array<char, 4096> ignored{};
    while (at < end) {
      const std::size_t size = std::min<std::uint64_t>(end - at, ignored.size());
      if (!fill(std::span(ignored).first(size))) return false;
    }
    return true;
  }
};

[[noreturn]] void fail_compressed(const std::string& file) {
  fail_file(file, "is compressed (LAZ): " + std::string(conversion_of("laz")));
}

/// Bytes of the header: at least those of its version.
std::string header_bytes(Stream& stream, const std::string& file) {
  std::string bytes(kSmallestHeader, '\0');
  if (!stream.fill(bytes)) fail_file(file, "is truncated within its header");
  const int major = static_cast<unsigned char>(bytes[24]);
  const int minor = static_cast<unsigned char>(bytes[25]);
  if (major != 1 || minor < 2 || minor > 4) {
    fail_file(file, "is LAS " + std::to_string(major) + "." + std::to_string(minor) +
                        ", not 1.2 to 1.4: write it as LAS 1.4 first, as pdal translate does");
  }
  const std::size_t size = load<std::uint16_t>(bytes.data() + 94, false);
  const std::size_t least = minor == 4 ? 375 : minor == 3 ? 235 : kSmallestHeader;
  if (size < least) {
    fail_file(file, "byte 94: a header of LAS 1." + std::to_string(minor) + " has " +
                        std::to_string(least) + " bytes at least, not " + std::to_string(size));
  }
  bytes.resize(size);
  if (!stream.fill(std::span(bytes).subspan(kSmallestHeader))) {
    fail_file(file, "is truncated within its header");
  }
  return bytes;
}

LasHeader read_las_header(Stream& stream, const std::string& file) {
  const std::string bytes = header_bytes(stream, file);
  const char* const at = bytes.data();
  LasHeader header;
  header.points_begin = load<std::uint32_t>(at + 96, false);
  header.records = load<std::uint32_t>(at + 100, false);
  header.format = static_cast<unsigned char>(at[104]);
  header.point_size = load<std::uint16_t>(at + 105, false);
  header.points = load<std::uint32_t>(at + 107, false);
  // From 1.4 on; the count of 32 bits is then 0 where it does not fit.
  if (at[25] == 4) {
    const auto points = load<std::uint64_t>(at + 247, false);
    if (points != 0) header.points = points;
  }
  if ((header.format & 0x80U) != 0) fail_compressed(file);
  if (header.format >= kPointSizes.size()) {
    fail_file(file,
              "byte 104: point format " + std::to_string(header.format) + " is not one of 0 to 10");
  }
  if (header.point_size < kPointSizes[header.format]) {
    fail_file(file, "byte 105: a point of format " + std::to_string(header.format) + " has " +
                        std::to_string(kPointSizes[header.format]) + " bytes at least, not " +
                        std::to_string(header.point_size));
  }
  if (header.points_begin < bytes.size()) {
    fail_file(file, "byte 96: its points can't begin at byte " +
                        std::to_string(header.points_begin) + ", within the header");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = load<double>(at + 131 + 8 * axis, false);
    header.offset[axis] = load<double>(at + 155 + 8 * axis, false);
    const std::string name(1, "xyz"[axis]);
    if (!(header.scale[axis] > 0.0 && std::isfinite(header.scale[axis]))) {
      fail_file(file, "byte " + std::to_string(131 + 8 * axis) + ": the scale of " + name +
                          " is not a finite number above 0");
    }
    if (!std::isfinite(header.offset[axis])) {
      fail_file(file, "byte " + std::to_string(155 + 8 * axis) + ": the offset of " + name +
                          " is not finite");
    }
  }
  return header;
}

/// Goes on to the first point. Of the records on the way only LASzip's matters.
void skip_records(const LasHeader& header, Stream& stream, const std::string& file) {
  std::array<char, 54> record{};
  for (std::uint32_t i = 0; i < header.records; ++i) {
    // Records of nothing that are promised without end are not looked for.
    if (header.points_begin - stream.at < record.size() || !stream.fill(record)) break;
    if (std::string_view(record.data() + 2, 14) == "laszip encoded") fail_compressed(file);
    const std::uint64_t end = stream.at + load<std::uint16_t>(record.data() + 20, false);
    if (!stream.skip_to(std::min(end, header.points_begin))) break;
  }
  if (stream.skip_to(header.points_begin)) return;
  fail_file(file, "is truncated: its points should begin at byte " +
                      std::to_string(header.points_begin) + ", it ends at " +
                      std::to_string(stream.at));
}

/// Whether whoever made the file took the point back.
bool is_withheld(const char* point, unsigned format) {
  const auto flags = static_cast<unsigned char>(point[15]);
  return (flags & (format < 6 ? 0x80U : 0x04U)) != 0;
}

Eigen::Vector3d position_of(const char* point, const LasHeader& header) {
  Eigen::Vector3d position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double steps = load<std::int32_t>(point + 4 * axis, false);
    position[static_cast<Eigen::Index>(axis)] = steps * header.scale[axis] + header.offset[axis];
  }
  return position;
}

}  // namespace

bool is_las(std::string_view bytes) { return bytes.starts_with("LASF"); }

void read_las_points(const ByteReader& read, const std::string& file, const PointTaker& take) {
  Stream stream{read};
  const LasHeader header = read_las_header(stream, file);
  skip_records(header, stream, file);
  const std::size_t size = header.point_size;
  std::vector<char> piece(std::min<std::uint64_t>(kPiece / size, header.points) * size);
  for (std::uint64_t done = 0; done < header.points;) {
    poll_caller();
    const std::uint64_t begin = stream.at;
    const std::uint64_t wanted = std::min<std::uint64_t>(header.points - done, piece.size() / size);
    const bool is_there = stream.fill(std::span(piece).first(wanted * size));
    const std::uint64_t found = (stream.at - begin) / size;
    for (std::uint64_t i = 0; i < found; ++i) {
      const char* const point = piece.data() + i * size;
      if (is_withheld(point, header.format)) continue;
      const Eigen::Vector3d position = position_of(point, header);
      if (position.allFinite()) take(position);
    }
    done += found;
    if (is_there) continue;
    fail_file(file, "is truncated: the header promises " + std::to_string(header.points) +
                        " points, there are " + std::to_string(done));
  }
}

FilePoints parse_las_points(std::string_view bytes, const std::string& file) {
  const auto read = [&](std::span<char> taken) {
    const std::size_t count = bytes.copy(taken.data(), taken.size());
    bytes.remove_prefix(count);
    return count;
  };
  FilePoints points;
  read_las_points(read, file, [&](const Eigen::Vector3d& point) { points.push_back(point); });
  return points;
}

}  // namespace avoidbench
