#pragma once

#include <filesystem>

namespace avoidbench {

/// Keeps other runs and merges from writing to a database file: a lock of one byte far beyond what
/// SQLite locks, so that readers are free. It ends with the process, however that ends, and is not
/// inherited by programs that the process starts. As closing any descriptor of a file drops this
/// process's other locks of it, SQLite's too, it must live longer than SQLite's handle.
class RunLock {
 public:
  /// Throws InputError that says who writes to `file`, where somebody does and goes on for a
  /// second, or where it can't be opened.
  explicit RunLock(const std::filesystem::path& file);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// Whether the file's name at the beginning still is this file.
  bool is_in_place() const;
  /// Where the file is now; empty where it was deleted or that can't be found out.
  std::filesystem::path place_now() const;

 private:
  std::filesystem::path file_;  // absolute
  int descriptor_ = -1;
};

}  // namespace avoidbench
