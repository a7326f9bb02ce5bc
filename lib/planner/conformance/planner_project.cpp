#include "conformance/planner_project.hpp"

#include <array>
#include <cctype>
#include <fstream>
#include <utility>
#include <vector>

#include "base/input_error.hpp"
#include "base/input_file.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// Of a template: they have some kilobytes.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 20U;

// The name becomes a C identifier, a target of CMake and the table's name, which planner.h limits
// to these letters.
bool is_name(const std::string& name) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz";
  return !name.empty() && kLetters.find(name.front()) != std::string::npos &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

/// my_planner: MyPlanner.
std::string class_name(const std::string& name) {
  std::string words;
  bool is_first = true;
  for (const char letter : name) {
    if (letter == '_') {
      is_first = true;
    } else {
      // Of a-z alone, so no locale has a say.
      words += is_first ? static_cast<char>(std::toupper(letter)) : letter;
      is_first = false;
    }
  }
  return words;
}

/// Names that CMake has for targets of its own, or the program for its own files.
bool is_taken(const std::string& name) {
  for (const char* taken : {"all", "clean", "edit_cache", "help", "install",
                            "list_install_components", "program", "rebuild_cache", "test"}) {
    if (name == taken) return true;
  }
  // The template's code uses a Vec3, which is what class_name() would call the planner.
  return name.starts_with("avoidbench") || name.starts_with("package") ||
         class_name(name) == "Vec3";
}

using Names =
    std::pair<std::string, std::string>;  ///< of a template, without .in; of what it becomes

std::vector<Names> project_files(const std::string& name, ProjectKind kind) {
  std::vector<Names> files;
  switch (kind) {
    case ProjectKind::example:
      files = {{"planner.cpp", name + ".cpp"}, {"CMakeLists.txt", "CMakeLists.txt"}};
      break;
    case ProjectKind::cpp_class:
      files = {{"class.hpp", name + ".hpp"},
               {"class_planner.cpp", name + ".cpp"},
               {"CMakeLists.txt", "CMakeLists.txt"}};
      break;
    case ProjectKind::python:
      files = {{"planner.py", name + ".py"}};
      break;
    case ProjectKind::weights:
      files = {{"weights_planner.py", name + ".py"}, {"weights.json", "weights.json"}};
      break;
  }
  for (const char* always : {"README.md", "sweep.yaml"}) files.emplace_back(always, always);
  return files;
}

std::string filled_in(std::string text, const std::string& name, ProjectKind kind) {
  const std::array<std::pair<std::string, std::string>, 3> words{
      {{"@NAME@", name}, {"@CLASS@", class_name(name)}, {"@PLUGIN@", project_plugin(name, kind)}}};
  for (const auto& [word, value] : words) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
      text.replace(at, word.size(), value);
      // Behind what was put in: a name can't be replaced again.
      at += value.size();
    }
  }
  return text;
}

}  // namespace

std::string project_plugin(const std::string& name, ProjectKind kind) {
  const bool is_python = kind == ProjectKind::python || kind == ProjectKind::weights;
  return is_python ? name + ".py" : "./build/planners/" + name + ".so";
}

std::vector<std::string> write_planner_project(const std::string& name, ProjectKind kind,
                                               const fs::path& folder, const fs::path& templates) {
  if (!is_name(name)) {
    throw InputError("'" + name +
                     "' is not a name of a planner: use a-z, 0-9 and _, and begin with a letter");
  }
  if (is_taken(name)) throw InputError("the name '" + name + "' is taken by the build");
  // All is read and looked at before anything is written, so that an error leaves no half project.
  std::vector<std::pair<fs::path, std::string>> files;
  std::vector<std::string> names;
  for (const auto& [from, to] : project_files(name, kind)) {
    names.push_back(to);
    files.emplace_back(
        folder / to,
        filled_in(read_input_file(templates / (from + ".in"), kMostBytes), name, kind));
    std::error_code error;
    // symlink_status: a dangling link is there, too; writing through it would make a file
    // elsewhere.
    if (fs::exists(fs::symlink_status(files.back().first, error))) {
      throw InputError(files.back().first.string() + " exists already; nothing was written");
    }
  }
  std::error_code error;
  fs::create_directories(folder, error);
  for (const auto& [file, text] : files) {
    if ((std::ofstream(file, std::ios::binary) << text).flush()) continue;
    // None was there before.
    for (const auto& [written, of] : files) fs::remove(written, error);
    throw InputError(file.string() + ": can't be written");
  }
  return names;
}

}  // namespace avoidbench
