#include "program_planner/program_start.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <functional>
#include <mutex>
#include <thread>

#include "base/input_error.hpp"
#include "process/inherited.hpp"
#include "process/sandbox.hpp"

namespace avoidbench {
namespace {

/// A thread that starts programs and lives as long as the process does: a death signal comes when
/// the thread ends that started a process, and planners are made by threads that end earlier.
class Starter {
 public:
  Starter() : process_(::getpid()) {
    std::thread([this] { run(); }).detach();
  }

  /// The one of this process: a fork takes no threads along.
  static Starter& of_process() {
    static std::mutex mutex;
    static Starter* starter = nullptr;
    const std::lock_guard lock(mutex);
    // The old one is not deleted: threads that do not exist here may hold its locks.
    if (starter == nullptr || starter->process_ != ::getpid()) starter = new Starter;
    return *starter;
  }

  pid_t start(const std::function<pid_t()>& task) {
    const std::lock_guard one_at_a_time(turn_);
    std::unique_lock lock(mutex_);
    task_ = &task;
    changed_.notify_all();
    changed_.wait(lock, [this] { return task_ == nullptr; });
    return result_;
  }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return task_ != nullptr; });
      result_ = (*task_)();
      task_ = nullptr;
      changed_.notify_all();
    }
  }

  pid_t process_;
  std::mutex turn_, mutex_;
  std::condition_variable changed_;
  const std::function<pid_t()>* task_ = nullptr;
  pid_t result_ = -1;
};

/// From here to exec() nothing may allocate: other threads of the process may have held locks.
void say(int fd, const char* what, int error) {
  // strerror() may translate, and so allocate; this gives a constant.
  const char* parts[] = {"can't be started: ", what, ": ", ::strerrordesc_np(error), "\n"};
  for (const char* part : parts) {
    if (part != nullptr && ::write(fd, part, std::strlen(part)) < 0) return;
  }
}

void use_own_signals() {
  // Handlers end with exec(), but what is ignored stays ignored: a program would inherit SIGPIPE's.
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Descriptors above those that the program gets: a copy must not overwrite one yet to be copied.
struct HighFds {
  explicit HighFds(const ProgramStart& start) {
    constexpr int kAbove = kProgramSegmentFd + 6;
    int* own[] = {&prints, &socket, &segment};
    const int of[] = {start.prints_fd, start.socket_fd, start.segment_fd};
    for (std::size_t i = 0; i < 3; ++i) *own[i] = ::fcntl(of[i], F_DUPFD_CLOEXEC, kAbove);
  }
  ~HighFds() {
    for (const int fd : {prints, socket, segment}) {
      if (fd >= 0) ::close(fd);
    }
  }
  HighFds(const HighFds&) = delete;
  HighFds& operator=(const HighFds&) = delete;
  int prints = -1, socket = -1, segment = -1;
};

[[noreturn]] void be_program(char* const* words, char* const* variables, const char* folder,
                             const HighFds& fds, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // A parent that ended before prctl() sends no signal any more.
  if (::getppid() != parent) ::_exit(127);
  ::setpgid(0, 0);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(fds.prints, STDOUT_FILENO);
  // Copies are not closed by exec(), as the originals are.
  ::dup2(fds.prints, STDERR_FILENO);
  ::dup2(fds.socket, kProgramSocketFd);
  ::dup2(fds.segment, kProgramSegmentFd);
  close_from(kProgramSegmentFd + 1);
  use_own_signals();
  if (!enter_inner_sandbox()) {
    say(STDERR_FILENO, "sandbox", errno);
    ::_exit(127);
  }
  if (::chdir(folder) != 0) {
    say(STDERR_FILENO, folder, errno);
    ::_exit(127);
  }
  ::execve(words[0], words, variables);
  say(STDERR_FILENO, words[0], errno);
  ::_exit(127);
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

pid_t start_program(const ProgramStart& start) {
  std::vector<std::string> words = start.words, variables = start.variables;
  const std::vector<char*> word_pointers = pointers_to(words);
  const std::vector<char*> variable_pointers = pointers_to(variables);
  const HighFds fds(start);
  int error = 0;
  const pid_t pid = Starter::of_process().start([&]() -> pid_t {
    const pid_t parent = ::getpid();
    // No handler of this process may run in the new one.
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t child = ::fork();
    if (child == 0) {
      be_program(word_pointers.data(), variable_pointers.data(), start.folder.c_str(), fds, parent);
    }
    error = errno;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return child;
  });
  if (pid < 0) {
    throw InputError("can't start " + start.words.front() + ": fork: " + std::strerror(error));
  }
  ::setpgid(pid, pid);  // whoever is first: a kill of the group must never come too early
  return pid;
}

}  // namespace avoidbench
