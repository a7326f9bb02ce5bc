#pragma once

#include <concepts>
#include <filesystem>
#include <string>
#include <vector>

namespace avoidbench {

/// Stands for the planner's own file in a command: specs and databases keep no folders.
inline constexpr const char* kFileWord = "{file}";

/// Where a planner is: the file of its library or program, and, of a program that a sweep starts in
/// its own way, the words to start it by.
struct PlannerSource {
  std::filesystem::path file;
  std::vector<std::string> command;  ///< with kFileWord; empty: as a file of its kind is started

  PlannerSource() = default;
  PlannerSource(std::filesystem::path given, std::vector<std::string> words)
      : file(std::move(given)), command(std::move(words)) {}
  /// Most planners are just a file.
  template <class File>
  requires std::convertible_to<const File&, std::filesystem::path> PlannerSource(const File& given)
      : file(given) {}
};

/// The source that the words of a command mean, where relative paths are relative to `folder`: its
/// file is the first word after the program that names a file, else the program itself. Throws
/// InputError where there is no such program.
PlannerSource source_of_command(const std::vector<std::string>& words,
                                const std::filesystem::path& folder);

/// Whether a file that is no library can be started as a planner: a .py, or one that may be
/// executed.
bool can_be_started(const std::filesystem::path& file);

/// The words that start the program, the first one a path; the file by its absolute path. A .py is
/// run by Python with avoidbench's client. Throws InputError where there is no such Python, or the
/// command's program is not found.
std::vector<std::string> words_to_start(const PlannerSource& source);

/// Looks for the Python of planners, if this one is for Python, so that processes that this one
/// forks, or starts with python_variable(), need not: a process that is killed while it looks
/// leaves behind what looks for it. Where there is none, words_to_start() says so.
void find_python(const PlannerSource& source);

/// "AVOIDBENCH_PLANNER_PYTHON=python3", for the environment of processes that start planners; ""
/// where none was looked for.
std::string python_variable();

/// What it is started with: this process's variables and those of the client.
std::vector<std::string> environment_to_start();

}  // namespace avoidbench
