#include "plots.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

constexpr const char* kScript = "paper_figures.py";

/// Runs the program (looked for on the PATH) to its end; its exit code, or -1 where it can't be
/// run.
int exit_code_of(const std::vector<std::string>& command, bool is_silent) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (is_silent) {
    for (const int fd : {STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(&actions, fd, "/dev/null", O_WRONLY, 0);
    }
  }
  pid_t pid = 0;
  const int error =
      ::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), ::environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -1;
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The script beside the program: in the build tree, or where the program is installed.
std::filesystem::path script_file(const std::filesystem::path& program) {
  const std::filesystem::path folder = program.parent_path();
  std::error_code error;
  for (const std::filesystem::path& file :
       {folder / "plot" / kScript, folder.parent_path() / AVOIDBENCH_PLOT_FOLDER / kScript}) {
    if (std::filesystem::is_regular_file(file, error)) return file;
  }
  throw InputError(std::string("figures: ") + kScript + " is not beside " + program.string() +
                   ": build or install avoidbench whole");
}

/// A Python that has what the script needs.
std::string python() {
  const char* chosen = std::getenv("AVOIDBENCH_PYTHON");
  const std::vector<std::string> candidates =
      chosen != nullptr && *chosen != '\0'
          ? std::vector<std::string>{chosen}
          : std::vector<std::string>{"python3", "/usr/bin/python3"};
  for (const std::string& candidate : candidates) {
    const bool is_good = exit_code_of({candidate, "-c",
                                       "import importlib.util as u, sys; sys.exit(not all("
                                       "u.find_spec(m) for m in ('matplotlib', 'pandas')))"},
                                      true) == 0;
    if (is_good) return candidate;
  }
  std::string tried;
  for (const std::string& candidate : candidates) tried += (tried.empty() ? "" : ", ") + candidate;
  throw InputError("figures need Python with matplotlib and pandas (tried " + tried +
                   "): apt-get install python3-matplotlib python3-pandas, or name a Python that "
                   "has them by AVOIDBENCH_PYTHON");
}

}  // namespace

void draw_plots(const std::vector<std::string>& databases, const std::string& sweep,
                const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  std::vector<std::string> command = {python(),    script_file(program).string(),
                                      "--program", program.string(),
                                      "--output",  folder.string()};
  if (!sweep.empty()) command.insert(command.end(), {"--sweep", sweep});
  command.emplace_back("--");
  command.insert(command.end(), databases.begin(), databases.end());
  const int code = exit_code_of(command, false);
  if (code != 0) throw InputError("figures could not be drawn: see above");
}

}  // namespace avoidbench
