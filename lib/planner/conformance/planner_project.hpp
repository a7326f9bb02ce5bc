#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace avoidbench {

/// What a planner begins from: an example in C++; a C++ class with plain inputs behind an adapter;
/// an example in Python; a Python class with weights.
enum class ProjectKind { example, cpp_class, python, weights };

/// Writes a planner to begin from to `folder`, out of the files of `templates`, and returns what
/// was written, the planner first. Throws InputError if `name` can't be the name of one, or a file
/// is there already or can't be written; then none is written.
std::vector<std::string> write_planner_project(const std::string& name, ProjectKind kind,
                                               const std::filesystem::path& folder,
                                               const std::filesystem::path& templates);

/// What a sweep in that folder calls it: the library's file or the script's.
std::string project_plugin(const std::string& name, ProjectKind kind);

}  // namespace avoidbench
