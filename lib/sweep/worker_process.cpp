#include "sweep/worker_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "base/input_error.hpp"

extern char** environ;  // NOLINT(readability-identifier-naming): POSIX's name

namespace avoidbench {
namespace {

constexpr int kJobFd = 3, kResultFd = 4;

/// The C library picks variants of sin, exp, … by the processor; those with fused multiply-add
/// differ in the last bit. Planners use the C library, so workers run without those variants: the
/// same planner gives the same bits everywhere.
constexpr const char* kTunables =
    "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-FMA_Usable,-FMA4_Usable";

std::vector<char*> child_environment() {
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (std::strncmp(*variable, "GLIBC_TUNABLES=", 15) != 0) variables.push_back(*variable);
  }
  variables.push_back(const_cast<char*>(kTunables));
  variables.push_back(nullptr);
  return variables;
}

[[noreturn]] void fail(const char* what, int error) {
  throw InputError(std::string("can't start a worker process: ") + what + ": " +
                   std::strerror(error));
}

}  // namespace

void enter_worker_environment() {
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (std::strcmp(*variable, kTunables) == 0) return;
  }
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string word; std::getline(file, word, '\0');) arguments.push_back(word);
  if (arguments.empty()) return;
  std::vector<char*> pointers;
  for (std::string& word : arguments) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execve("/proc/self/exe", pointers.data(), child_environment().data());
}

WorkerProcess::WorkerProcess(const std::vector<std::string>& command) {
  int jobs[2], results[2];
  if (::pipe2(jobs, O_CLOEXEC) != 0) fail("pipe", errno);
  if (::pipe2(results, O_CLOEXEC) != 0) fail("pipe", errno);
  // Moved out of the way first, so that the two dup2 of the child can't overwrite each other's
  // source.
  const int child_in = ::fcntl(jobs[0], F_DUPFD_CLOEXEC, 10);
  const int child_out = ::fcntl(results[1], F_DUPFD_CLOEXEC, 10);
  ::close(jobs[0]);
  ::close(results[1]);
  job_fd_ = jobs[1];
  result_fd_ = results[0];

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, child_in, kJobFd);
  posix_spawn_file_actions_adddup2(&actions, child_out, kResultFd);
  std::vector<std::string> words = command;
  words.push_back(std::to_string(kJobFd));
  words.push_back(std::to_string(kResultFd));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::vector<char*> variables = child_environment();
  const int error =
      ::posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), variables.data());
  posix_spawn_file_actions_destroy(&actions);
  ::close(child_in);
  ::close(child_out);
  if (error != 0) {
    pid_ = -1;
    close_all();
    fail(words[0].c_str(), error);
  }
}

WorkerProcess::~WorkerProcess() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    wait();
  }
  close_all();
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      job_fd_(std::exchange(other.job_fd_, -1)),
      result_fd_(std::exchange(other.result_fd_, -1)) {}

WorkerProcess& WorkerProcess::operator=(WorkerProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(job_fd_, other.job_fd_);
  std::swap(result_fd_, other.result_fd_);
  return *this;
}

bool WorkerProcess::send(const Message& message) { return send_message(job_fd_, message); }

std::optional<Message> WorkerProcess::receive() { return receive_message(result_fd_); }

ProcessEnd WorkerProcess::wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return {.text = "signal " + std::to_string(number) + " (" + ::strsignal(number) + ")",
            .exit_code = -1};
  }
  const int code = WEXITSTATUS(status);
  return {.text = "exit code " + std::to_string(code), .exit_code = code};
}

void WorkerProcess::close_all() {
  if (job_fd_ >= 0) ::close(job_fd_);
  if (result_fd_ >= 0) ::close(result_fd_);
  job_fd_ = result_fd_ = -1;
}

}  // namespace avoidbench
