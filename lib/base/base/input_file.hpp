#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace avoidbench {

/// Above any library, mesh or point cloud that can be used: what is larger is refused unread.
inline constexpr std::uint64_t kMostFileBytes = 4'000'000'000;

/// A file of the user's, open for reading. Only regular files are: a device may have no end, and a
/// pipe no writer. A pipe that this process holds already, as /dev/fd/63 of `<(command)`, has one.
/// Every reader of configurations, maps, tables and libraries opens its files by this.
class InputFile {
 public:
  /// Throws InputError with the path where there is no such file, or it is a folder, device, pipe
  /// or socket, holds more than `most_bytes`, or can't be opened. Never blocks, except for the
  /// writer of a pipe that this process holds.
  InputFile(const std::filesystem::path& path, std::uint64_t most_bytes);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Fills `bytes` with what comes next and returns how many there were; fewer than its size only
  /// at the end of the file. Throws InputError where the file can't be read, or has grown beyond
  /// `most_bytes`.
  std::size_t read(std::span<char> bytes);

  /// All that comes next. Throws as read() does.
  std::string read_rest();

 private:
  void check_size(std::uint64_t bytes) const;

  std::filesystem::path path_;
  std::uint64_t most_bytes_ = 0, size_bytes_ = 0, read_bytes_ = 0;
  int descriptor_ = -1;
};

/// What standard input gives, to its end. Throws InputError where that is more than `most_bytes`.
std::string read_standard_input(std::uint64_t most_bytes);

/// The bytes of a file. Throws InputError as InputFile does.
std::string read_input_file(const std::filesystem::path& path, std::uint64_t most_bytes);

}  // namespace avoidbench
