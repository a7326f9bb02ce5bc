#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "trial/trial_spec.hpp"

namespace avoidbench {

/// What changes whenever a file is written to or replaced: also where its time of writing is set
/// back, which leaves the time of the change of its state.
struct FileState {
  dev_t device = 0;
  ino_t inode = 0;
  off_t bytes = -1;  ///< -1: no such file
  std::int64_t written_ns = 0, changed_ns = 0;
  bool operator==(const FileState&) const = default;
};

FileState file_state(const std::filesystem::path& file);

/// The planner's file and those that it names.
std::vector<std::filesystem::path> files_of(const PluginChoice& plugin);

}  // namespace avoidbench
