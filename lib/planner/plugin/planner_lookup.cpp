#include <algorithm>
#include <cstdlib>
#include <set>

#include "base/data_folder.hpp"
#include "base/input_error.hpp"
#include "base/input_file.hpp"
#include "plugin/planner_library.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// Each once: the build's own may be on the path, too.
void add_folder(std::vector<fs::path>& folders, const fs::path& folder) {
  const fs::path plain = folder.lexically_normal();
  if (std::find(folders.begin(), folders.end(), plain) == folders.end()) folders.push_back(plain);
}

/// The folder planners/ of the build tree that the program at `program` was built in, or "".
fs::path build_tree_planners(const fs::path& program) {
  std::error_code error;
  fs::path folder = program.parent_path();
  for (int level = 0; level < 6 && folder.has_relative_path(); ++level) {
    if (fs::exists(folder / "CMakeCache.txt", error)) return folder / "planners";
    folder = folder.parent_path();
  }
  return {};
}

/// Whether the file is a Python script that may be a planner: one that speaks of avoidbench, unlike
/// what lies beside it to be imported.
bool is_planner_script(const fs::path& file) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 20U;
  if (file.extension() != ".py") return false;
  try {
    // The whole file: an import may stand anywhere.
    return read_input_file(file, kMostBytes).find("avoidbench") != std::string::npos;
  } catch (const InputError&) {
    return false;
  }
}

/// Names of the planners in the folders: of libraries without .so, of Python's with .py.
std::vector<std::string> names_in(const std::vector<fs::path>& folders) {
  // Each name once: a file in an earlier folder hides those in later ones.
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".so") names.insert(entry.path().stem().string());
      if (is_planner_script(entry.path())) names.insert(entry.path().filename().string());
    }
  }
  return {names.begin(), names.end()};
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

[[noreturn]] void fail_bare_name(const std::string& plugin, const std::vector<fs::path>& folders) {
  const std::vector<std::string> names = names_in(folders);
  std::vector<std::string> tried;
  for (const fs::path& folder : folders) tried.push_back(folder.string());
  std::string message = "no planner '" + plugin + "'" + did_you_mean(plugin, names);
  message += "; looked in " + (tried.empty() ? std::string("no folder") : joined(tried));
  message += names.empty() ? " and found none" : " and found " + joined(names);
  if (plugin.ends_with(".so")) message += "; write ./" + plugin + " for a file in this folder";
  throw InputError(message);
}

[[noreturn]] void fail_path(const fs::path& file) {
  std::string message = "no planner library '" + file.string() + "'";
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const std::vector<std::string> names = names_in({folder});
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    message += ": there is no folder " + folder.string();
  } else {
    message += did_you_mean(file.stem().string(), names);
  }
  throw InputError(message);
}

}  // namespace

std::vector<fs::path> planner_search_path() {
  std::vector<fs::path> folders;
  const char* configured = std::getenv("AVOIDBENCH_PLANNER_PATH");
  std::string rest = configured != nullptr ? configured : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    // Empty entries are passed over. To the shell they are the working folder, from which no code
    // should come unasked.
    if (colon != 0) add_folder(folders, rest.substr(0, colon));
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  const fs::path program = program_file();
  if (program.empty()) return folders;
  // Before what is installed: these are of this very build.
  const fs::path built = build_tree_planners(program);
  if (!built.empty()) add_folder(folders, built);
  // The program is in PREFIX/bin.
  add_folder(folders, program.parent_path().parent_path() / AVOIDBENCH_PLUGIN_FOLDER);
  return folders;
}

fs::path find_planner(const std::string& plugin, const fs::path& base_folder) {
  if (plugin.empty()) throw InputError("the planner's name is empty");
  std::error_code error;
  if (plugin.find('/') != std::string::npos) {
    const fs::path given(plugin);
    const fs::path file = (given.is_absolute() ? given : base_folder / given).lexically_normal();
    if (!fs::exists(file, error)) fail_path(file);
    return file;
  }
  const bool is_script = plugin.ends_with(".py");
  // Nobody means a library by that, so a script beside the sweep needs no ./ before its name.
  if (is_script && fs::is_regular_file(base_folder / plugin, error)) {
    return (base_folder / plugin).lexically_normal();
  }
  const std::vector<fs::path> folders = planner_search_path();
  for (const fs::path& folder : folders) {
    const fs::path file = folder / (is_script ? plugin : plugin + ".so");
    if (fs::is_regular_file(file, error)) return file;
  }
  fail_bare_name(plugin, folders);
}

std::vector<PlannerDescription> list_planners(std::vector<std::string>& problems) {
  const std::vector<fs::path> folders = planner_search_path();
  std::vector<PlannerDescription> planners;
  for (const std::string& name : names_in(folders)) {
    try {
      // One that does not load must not hide the others.
      planners.push_back(describe_planner(find_planner(name, ".")));
    } catch (const InputError& error) {
      problems.emplace_back(error.what());
    }
  }
  std::stable_sort(planners.begin(), planners.end(),
                   [](const auto& a, const auto& b) { return a.name < b.name; });
  return planners;
}

}  // namespace avoidbench
