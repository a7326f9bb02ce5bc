#include "program_planner/planner_source.hpp"

#include <unistd.h>

#include <cstdlib>
#include <mutex>

#include "base/data_folder.hpp"
#include "base/input_error.hpp"
#include "process/program.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPythonVariable = "AVOIDBENCH_PLANNER_PYTHON";

std::mutex python_mutex;

/// Found by this process or the one that started it; "" before. Under the mutex.
std::string& known_python() {
  const char* given = std::getenv(kPythonVariable);
  static std::string python = given != nullptr ? given : "";
  return python;
}

/// Looked for once: to ask a Python what it has takes some 30 ms.
const std::string& python_of_planners() {
  const std::lock_guard lock(python_mutex);
  std::string& python = known_python();
  constexpr const char* kPurpose = "a planner in Python needs";
  try {
    if (python.empty()) python = python_with({"numpy"}, kPurpose);
  } catch (const InputError&) {
    // Somebody may have ended the Python that was asked, as the kernel short of memory does.
    python = python_with({"numpy"}, kPurpose);
  }
  return python;
}

bool is_for_python(const PlannerSource& source) {
  return source.command.empty() && source.file.extension() == ".py";
}

bool may_be_executed(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

/// A program named without a slash, as the shell finds it; else its path, relative ones to
/// `folder`.
std::string program_named(const std::string& name, const fs::path& folder) {
  if (name.find('/') != std::string::npos) {
    const fs::path file = (folder / name).lexically_normal();
    if (may_be_executed(file)) return file.string();
    throw InputError("there is no program " + file.string() + " that may be executed");
  }
  const char* given = std::getenv("PATH");
  std::string rest = given != nullptr ? given : "/usr/local/bin:/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const fs::path file = fs::path(rest.substr(0, colon)) / name;
    // Absolute, since it is started in the planner's folder and a PATH may have relative entries.
    if (may_be_executed(file)) return fs::absolute(file).string();
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  throw InputError("there is no program '" + name + "' on the PATH");
}

/// The folder in which Python finds avoidbench's client; "" where the program lies alone.
std::string client_folder() {
  const fs::path prefix = installation_prefix();
  if (prefix.empty()) return "";
  const fs::path folder = data_folder() / "python";
  std::error_code error;
  return fs::is_directory(folder, error) ? folder.string() : "";
}

bool sets(const std::string& variable, const std::string& name) {
  return variable.starts_with(name + "=");
}

}  // namespace

PlannerSource source_of_command(const std::vector<std::string>& words, const fs::path& folder) {
  std::vector<std::string> command = words;
  const fs::path program = program_named(words.front(), fs::absolute(folder));
  std::error_code error;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const fs::path file = (fs::absolute(folder) / words[i]).lexically_normal();
    if (words[i].empty() || !fs::is_regular_file(file, error)) continue;
    command[i] = kFileWord;
    // As the program is found again from there.
    const bool is_relative =
        words[0].find('/') != std::string::npos && !fs::path(words[0]).is_absolute();
    if (is_relative) command[0] = "./" + program.lexically_relative(file.parent_path()).string();
    // No further word is looked at: one file stands for the planner in keys.
    return {file, command};
  }
  command[0] = kFileWord;
  return {program, command};
}

bool can_be_started(const fs::path& file) {
  // A script needs no right to be executed: Python reads it.
  return file.extension() == ".py" || may_be_executed(file);
}

std::vector<std::string> words_to_start(const PlannerSource& source) {
  const std::string file = fs::absolute(source.file).lexically_normal().string();
  if (is_for_python(source)) {
    return {program_named(python_of_planners(), "."), "-m", "avoidbench.serving", file};
  }
  if (source.command.empty()) return {file};
  std::vector<std::string> words = source.command;
  for (std::string& word : words) {
    if (word == kFileWord) word = file;
  }
  // From the file's folder, where source_of_command() has written it from.
  words.front() = program_named(words.front(), fs::path(file).parent_path());
  return words;
}

void find_python(const PlannerSource& source) {
  try {
    if (is_for_python(source)) python_of_planners();
  } catch (const InputError&) {
    // Told where the planner is started.
  }
}

std::string python_variable() {
  const std::lock_guard lock(python_mutex);
  const std::string& python = known_python();
  return python.empty() ? "" : std::string(kPythonVariable) + "=" + python;
}

std::vector<std::string> environment_to_start() {
  // Texts hash in the same way in each process, prints come out before a crash, and a sandbox lets
  // nobody write bytecode.
  std::vector<std::string> variables{"PYTHONHASHSEED=0", "PYTHONUTF8=1", "PYTHONUNBUFFERED=1",
                                     "PYTHONDONTWRITEBYTECODE=1"};
  const std::string folder = client_folder();
  const char* path = std::getenv("PYTHONPATH");
  if (!folder.empty()) {
    const bool has_path = path != nullptr && *path != '\0';
    variables.push_back("PYTHONPATH=" + folder + (has_path ? ":" + std::string(path) : ""));
  }
  const std::size_t own = variables.size();
  // Ours alone: of a variable that is there twice some programs read the first, some the last.
  for (char** given = ::environ; *given != nullptr; ++given) {
    bool is_ours = false;
    for (std::size_t i = 0; i < own; ++i) {
      const std::string& variable = variables[i];
      is_ours = is_ours || sets(*given, variable.substr(0, variable.find('=')));
    }
    if (!is_ours) variables.emplace_back(*given);
  }
  return variables;
}

}  // namespace avoidbench
