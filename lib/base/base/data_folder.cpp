#include "base/data_folder.hpp"

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// AVOIDBENCH_DATA_FOLDER is relative to the prefix.
fs::path data_of(const fs::path& prefix) { return prefix / AVOIDBENCH_DATA_FOLDER; }

fs::path& named_program() {
  static fs::path file;
  return file;
}

}  // namespace

void set_program_file(const fs::path& file) { named_program() = file; }

fs::path program_file() {
  std::error_code error;
  // Within Python the interpreter is what runs: the extension names the program.
  if (!named_program().empty()) return named_program();
  return fs::read_symlink("/proc/self/exe", error);
}

fs::path installation_prefix() {
  std::error_code error;
  const fs::path program = program_file();
  // Upwards from the program: bin/ of an installation, or a folder of a build.
  for (fs::path folder = program.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    if (fs::is_directory(data_of(folder) / "configs", error)) return folder;
  }
  return {};
}

fs::path data_folder() {
  const fs::path prefix = installation_prefix();
  if (!prefix.empty()) return data_of(prefix);
  throw InputError(std::string("no folder ") + AVOIDBENCH_DATA_FOLDER +
                   " above this program: install all of avoidbench");
}

}  // namespace avoidbench
