#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace avoidbench {

/// A sweep that comes with the program.
struct BuiltInSweep {
  std::string name;            ///< "quick"
  std::string doc;             ///< the first comment of its file
  std::filesystem::path file;  ///< data_folder()/configs/sweeps/quick.yaml
};

/// All of them, by name. Throws InputError as data_folder().
std::vector<BuiltInSweep> built_in_sweeps();

/// The file that `given` means: a file of this name, or the built-in sweep of this name. Throws
/// InputError, with the names there are, for a bare name that is neither; anything else that looks
/// like a file's name comes back as it is.
std::filesystem::path sweep_file(const std::filesystem::path& given);

}  // namespace avoidbench
