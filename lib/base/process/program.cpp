#include "process/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

/// All that comes out of the pipe, which is closed then.
std::string read_to_end(int descriptor) {
  std::string text;
  std::array<char, 65536> bytes{};
  while (true) {
    const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  return text;
}

/// -1 where a signal ended it.
int exit_code_of(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string words_of(const std::vector<std::string>& words, const char* before) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + (before + word);
  return text;
}

}  // namespace

ProgramEnd run_program(const std::vector<std::string>& command, Standard output) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  std::array<int, 2> pipe{-1, -1};
  if (output == Standard::kept) {
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
      posix_spawn_file_actions_destroy(&actions);
      return {};
    }
    posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  } else if (output == Standard::dropped) {
    for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(&actions, descriptor, "/dev/null", O_WRONLY, 0);
    }
  }
  pid_t pid = 0;
  const int error =
      ::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), ::environ);
  posix_spawn_file_actions_destroy(&actions);
  // Else reading would wait for this process's own end.
  if (pipe[1] >= 0) ::close(pipe[1]);
  ProgramEnd end;
  if (pipe[0] >= 0) end.output = read_to_end(pipe[0]);
  if (error == 0) end.code = exit_code_of(pid);
  return end;
}

/// The first interpreter that finds the modules; it does not import them. With -c the folder that
/// one stands in, which may be a stranger's, is first on Python's path, as "": taken out before
/// anything is imported. (-I would take the user's own modules away, -P is of Python 3.11.)
std::string python_with(const std::vector<std::string>& modules, const std::string& purpose) {
  const char* chosen = std::getenv("AVOIDBENCH_PYTHON");
  const std::vector<std::string> candidates =
      // The first on the PATH may be a virtual environment that lacks what the system's Python has.
      chosen != nullptr && *chosen != '\0'
          ? std::vector<std::string>{chosen}
          : std::vector<std::string>{"python3", "/usr/bin/python3"};
  for (const std::string& candidate : candidates) {
    std::vector<std::string> command{candidate, "-c",
                                     "import sys\n"
                                     "sys.path[:] = filter(None, sys.path)\n"
                                     "import importlib.util as u\n"
                                     "sys.exit(not all(u.find_spec(m) for m in sys.argv[1:]))"};
    command.insert(command.end(), modules.begin(), modules.end());
    if (run_program(command, Standard::dropped).code == 0) return candidate;
  }
  throw InputError(purpose + " Python with " + words_of(modules, "") + " (tried " +
                   words_of(candidates, "") + "): apt-get install " +
                   words_of(modules, "python3-") +
                   ", or set AVOIDBENCH_PYTHON to a Python that has them");
}

}  // namespace avoidbench
