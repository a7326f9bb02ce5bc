#include "yaml/built_in_sweeps.hpp"

#include <algorithm>
#include <fstream>

#include "base/data_folder.hpp"
#include "base/input_error.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// The file's first comment: "# A first look: …" up to the first line that is indented or no
/// comment.
std::string first_comment(const fs::path& file) {
  std::ifstream in(file);
  std::string doc, line;
  while (std::getline(in, line) && line.starts_with("# ") && !line.starts_with("#  ")) {
    doc += (doc.empty() ? "" : " ") + line.substr(2);
  }
  return doc;
}

}  // namespace

std::vector<BuiltInSweep> built_in_sweeps() {
  std::vector<BuiltInSweep> sweeps;
  for (const auto& entry : fs::directory_iterator(data_folder() / "configs" / "sweeps")) {
    if (entry.path().extension() != ".yaml") continue;
    sweeps.push_back({entry.path().stem().string(), first_comment(entry.path()), entry.path()});
  }
  // Folders are listed in no particular order.
  std::sort(sweeps.begin(), sweeps.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return sweeps;
}

fs::path sweep_file(const fs::path& given) {
  std::error_code error;
  // `quick` may be a sweep's name; `quick.yaml`, `./quick` and `-` can only be files.
  const bool is_bare = !given.has_parent_path() && !given.has_extension() && given != "-";
  // A link that leads nowhere is a file all the same: reading it says what is wrong.
  if (!is_bare || fs::exists(given, error) || fs::is_symlink(given, error)) return given;
  std::vector<std::string> names;
  for (const BuiltInSweep& sweep : built_in_sweeps()) {
    if (sweep.name == given.string()) return sweep.file;
    names.push_back(sweep.name);
  }
  throw InputError("no file '" + given.string() + "' and no built-in sweep of this name" +
                   did_you_mean(given.string(), names) + "; built in: " + joined(names));
}

}  // namespace avoidbench
