#pragma once

#include <filesystem>
#include <string>

namespace avoidbench {

/// Writes a planner to begin from to `folder`: NAME.cpp, CMakeLists.txt, README.md, sweep.yaml, out
/// of the files of `templates`. Throws InputError if `name` can't be the name of one, or a file is
/// there already or can't be written; then none is written.
void write_planner_project(const std::string& name, const std::filesystem::path& folder,
                           const std::filesystem::path& templates);

}  // namespace avoidbench
