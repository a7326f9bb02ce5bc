#include "logs/recorded_flight.hpp"

#include <algorithm>

#include "base/input_error.hpp"
#include "logs/log_readers.hpp"
#include "yaml/yaml_tree.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

struct KnownStart {
  std::string_view bytes, meaning;
};

/// Files that a user may well give, and what to do about them.
constexpr KnownStart kOtherFiles[] = {
    {"#ROSBAG V1", "a bag of an old version; `rosbag fix` writes it as version 2.0"},
    {"\x28\xb5\x2f\xfd", "a file compressed with zstd: unpack it first (`zstd -d FILE`)"},
    {"\x1f\x8b", "a file compressed with gzip: unpack it first (`gunzip FILE`)"},
    {"BZh", "a file compressed with bzip2: unpack it first (`bunzip2 FILE`)"},
    {"\x04\x22\x4d\x18", "a file compressed with lz4: unpack it first (`lz4 -d FILE`)"},
    {"\xfd"
     "7zXZ",
     "a file compressed with xz: unpack it first (`unxz FILE`)"},
    {"PK\x03\x04", "a ZIP archive: unpack it first"},
    {"\xa3\x95", "a log of ArduPilot (DataFlash), which is not supported"}};

constexpr std::string_view kFormats =
    "recorded flights are ROS 1 bags, rosbag2 (SQLite or MCAP), ULog, and text in the formats of "
    "TUM and EuRoC";

void check_is_no_other_file(const ByteReader& in, std::string_view start) {
  if (start.empty()) refuse_file(in.file(), "an empty file");
  for (const auto& [bytes, meaning] : kOtherFiles) {
    if (start.starts_with(bytes)) refuse_file(in.file(), std::string(meaning));
  }
}

bool is_text(std::string_view start) {
  return std::none_of(start.begin(), start.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\r' && c != '\t';
  });
}

void read_file(const fs::path& file, FlightBuilder& flight) {
  FileBytes bytes(file);
  ByteReader in(bytes, file);
  if (in.peek(kSqliteMagic.size()) == kSqliteMagic) {
    read_db3(file, flight);
  } else {
    read_log(in, flight);
  }
}

/// The files of a rosbag2 in order, as its metadata.yaml says.
std::vector<fs::path> files_of_folder(const fs::path& folder) {
  const fs::path metadata = folder / "metadata.yaml";
  std::error_code error;
  if (!fs::exists(metadata, error)) {
    refuse_file(folder,
                "a folder without metadata.yaml; name the file to read, or the folder of a "
                "rosbag2 (`ros2 bag reindex` writes a metadata.yaml that is missing)");
  }
  const YamlNode root = read_yaml(metadata);
  const YamlNode* information = root.find("rosbag2_bagfile_information");
  const YamlNode* paths =
      information == nullptr ? nullptr : information->find("relative_file_paths");
  if (paths == nullptr || paths->kind != YamlNode::Kind::list || paths->items.empty()) {
    throw InputError(problem_at(
        root, "expected rosbag2_bagfile_information with a list relative_file_paths of files"));
  }
  std::vector<fs::path> files;
  for (const YamlNode& path : paths->items) {
    // Only the name: all files lie in the folder, though old versions wrote its name before theirs.
    const fs::path name = fs::path(path.scalar).filename();
    if (path.kind != YamlNode::Kind::scalar || name.empty() || name == "..") {
      throw InputError(problem_at(path, "expected a file, got " + found_text(path)));
    }
    files.push_back(folder / name);
  }
  return files;
}

}  // namespace

void read_log(ByteReader& in, FlightBuilder& flight) {
  const std::string start(in.peek(ByteReader::kMostPeeked));
  check_is_no_other_file(in, start);
  try {
    if (start.starts_with(kBagMagic)) {
      read_bag(in, flight);
    } else if (start.starts_with(kMcapMagic)) {
      read_mcap(in, flight);
    } else if (start.starts_with(kUlogMagic)) {
      read_ulog(in, flight);
    } else if (is_text(start)) {
      read_text_path(in, flight);
    } else {
      refuse_file(in.file(), "no recorded flight: " + std::string(kFormats));
    }
  } catch (const CutOff& cut) {
    flight.warn(in.file().string() + " is cut off at byte " + std::to_string(cut.position) +
                ", as after a crash: the flight's last seconds may be missing");
  }
}

RecordedFlight read_recorded_flight(const RecordedFlightChoice& choice) {
  FlightBuilder flight(choice);
  std::error_code error;
  if (fs::is_directory(choice.file, error)) {
    for (const fs::path& file : files_of_folder(choice.file)) read_file(file, flight);
  } else {
    read_file(choice.file, flight);
  }
  return flight.finish();
}

}  // namespace avoidbench
