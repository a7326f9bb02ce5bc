#include "sweep/file_state.hpp"

#include <sys/stat.h>

namespace avoidbench {

FileState file_state(const std::filesystem::path& file) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return {};
  const auto ns = [](const timespec& time) { return time.tv_sec * kNanoseconds + time.tv_nsec; };
  // Device and inode tell a file that was replaced by renaming; the time of change one whose time
  // of writing was set back.
  return {.device = found.st_dev,
          .inode = found.st_ino,
          .bytes = found.st_size,
          .written_ns = ns(found.st_mtim),
          .changed_ns = ns(found.st_ctim)};
}

std::vector<std::filesystem::path> files_of(const PluginChoice& plugin) {
  const std::filesystem::path own = plugin.file;
  std::vector<std::filesystem::path> files{own};
  // The first of a planner's files is its own.
  for (std::size_t i = 1; i < plugin.files.size(); ++i) {
    files.push_back((own.parent_path() / plugin.files[i].name).lexically_normal());
  }
  return files;
}

}  // namespace avoidbench
