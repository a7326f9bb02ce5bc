#include "sweep/file_state.hpp"

#include <sys/stat.h>

namespace avoidbench {

FileState file_state(const std::filesystem::path& file) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return {};
  const auto ns = [](const timespec& time) { return time.tv_sec * kNanoseconds + time.tv_nsec; };
  return {.device = found.st_dev,
          .inode = found.st_ino,
          .bytes = found.st_size,
          .written_ns = ns(found.st_mtim),
          .changed_ns = ns(found.st_ctim)};
}

}  // namespace avoidbench
