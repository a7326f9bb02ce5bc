#include "program_planner/started_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "base/input_error.hpp"
#include "process/process_tree.hpp"
#include "program_planner/program_start.hpp"

namespace avoidbench {
namespace {

constexpr long kPidFdOpen = 434;  // Linux 5.3; a number that older headers lack

std::string ending_of(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return "ended by signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
  }
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

/// Whether it ended by a signal that people, the kernel and schedulers end processes with.
bool may_be_killed(int status) {
  constexpr std::array kOfOthers{SIGKILL, SIGTERM, SIGHUP, SIGINT, SIGXCPU};
  return WIFSIGNALED(status) &&
         std::count(kOfOthers.begin(), kOfOthers.end(), WTERMSIG(status)) > 0;
}

/// A socket pair of this process and the program.
struct SocketPair {
  SocketPair() {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      throw InputError(std::string("can't start a planner's program: socketpair: ") +
                       std::strerror(errno));
    }
  }
  ~SocketPair() {
    for (const int fd : ends) {
      if (fd >= 0) ::close(fd);
    }
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;
  int ends[2] = {-1, -1};
};

}  // namespace

StartedProgram::StartedProgram(const PlannerSource& source)
    : name_(source.file.filename().string()) {
  const std::filesystem::path file = std::filesystem::absolute(source.file);
  start(words_to_start(source), file.parent_path().string());
}

StartedProgram::~StartedProgram() {
  kill();
  if (socket_ >= 0) ::close(socket_);
}

void StartedProgram::start(const std::vector<std::string>& words, const std::string& folder) {
  SocketPair sockets;
  std::vector<std::string> variables = environment_to_start();
  variables.push_back(std::string(AB_PROCESS_VARIABLE) + "=" + std::to_string(kProgramSocketFd) +
                      "," + std::to_string(kProgramSegmentFd));
  pid_ = start_program({.words = words,
                        .variables = std::move(variables),
                        .folder = folder,
                        .prints_fd = prints_.write_fd(),
                        .socket_fd = sockets.ends[1],
                        .segment_fd = segment_.fd()});
  // With it open here, the pipe would have no end when the program has one.
  prints_.close_write_end();
  socket_ = std::exchange(sockets.ends[0], -1);
  // Without one, an end is seen by looking ten times a second.
  pid_fd_ = static_cast<int>(::syscall(kPidFdOpen, pid_, 0));
  if (pid_fd_ >= 0) ::fcntl(pid_fd_, F_SETFD, FD_CLOEXEC);
  has_cpu_clock_ = ::clock_getcpuclockid(pid_, &cpu_clock_) == 0;
}

const std::vector<std::byte>& StartedProgram::ask(
    std::uint32_t kind, const std::function<std::uint64_t(Segment&)>& write_body) {
  const ab_process_word word{++sequence_, kind};
  segment_.begin_request(word.sequence, kind);
  segment_.end_request(write_body ? write_body(segment_) : 0);
  ssize_t sent = 0;
  do {
    // EPIPE in place of SIGPIPE; and who reads nothing must not stop the host.
    sent = ::send(socket_, &word, sizeof word, MSG_NOSIGNAL | MSG_DONTWAIT);
  } while (sent < 0 && errno == EINTR);
  if (sent < 0 && errno == EPIPE) fail_as_ended();
  if (sent != static_cast<ssize_t>(sizeof word)) fail("does not take requests from its socket");
  wait_for_word(word);
  if (!segment_.copy_answer(answer_)) fail("says that its answer has an impossible size");
  ab_process_answer answer{};
  std::memcpy(&answer, answer_.data(), sizeof answer);
  if (answer.sequence != word.sequence || answer.kind != kind) {
    fail("has written the answer to another request");
  }
  return answer_;
}

void StartedProgram::wait_for_word(ab_process_word expected) {
  bool has_word = false;
  while (!has_word) {
    if (!wait_for_events(has_word)) fail_as_ended();
  }
  // Room for two, so that a second one is seen.
  std::array<std::byte, 2 * sizeof(ab_process_word)> bytes{};
  const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count == 0 || (count < 0 && errno == ECONNRESET)) fail_as_ended();
  if (count != static_cast<ssize_t>(sizeof expected)) {
    fail("has sent " + std::to_string(count) + " bytes through its socket instead of one word");
  }
  if (std::memcmp(bytes.data(), &expected, sizeof expected) != 0) {
    fail("has sent a word that answers another request");
  }
}

/// Waits until there is something to read or the program's end. False at the end.
bool StartedProgram::wait_for_events(bool& has_word) {
  constexpr int kLook_ms = 100;
  std::array<pollfd, 3> waiting{pollfd{socket_, POLLIN, 0}, pollfd{prints_.read_fd(), POLLIN, 0},
                                pollfd{pid_fd_, POLLIN, 0}};  // a negative one is passed over
  const bool has_pid_fd = pid_fd_ >= 0;
  // However long: the worker's watchdog ends what takes too long.
  ::poll(waiting.data(), waiting.size(), has_pid_fd ? -1 : kLook_ms);
  has_word = waiting[0].revents != 0;
  // A full pipe would stop the program in its print, and with it the answer.
  if (waiting[1].revents != 0) prints_.drain();
  if (has_word) return true;
  return has_pid_fd ? waiting[2].revents == 0 : !has_ended();
}

bool StartedProgram::has_ended() const {
  siginfo_t info{};
  // WNOWAIT: not reaped here, so that its number stays its own until end_family().
  return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid_;
}

bool StartedProgram::still_lives() {
  if (!is_alive()) return false;
  if (!has_ended()) return true;
  kill();
  return false;
}

double StartedProgram::cpu_time_s() const {
  timespec used{};
  if (!has_cpu_clock_ || ::clock_gettime(cpu_clock_, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

void StartedProgram::fail_as_ended() {
  // Its socket is closed; a moment for the end itself, which says more.
  constexpr int kLooks = 200, kLook_us = 1000;
  for (int i = 0; i < kLooks && !has_ended(); ++i) ::usleep(kLook_us);
  if (!has_ended()) fail("has closed its socket");
  // Before the end: its last words may still lie in the pipe.
  prints_.drain();
  const int status = kill();
  const std::string printed = prints_.last_lines();
  throw ProgramFault("the program " + name_ + " " + ending_of(status) +
                         (printed.empty() ? "" : "; it printed: " + printed),
                     true, may_be_killed(status));
}

void StartedProgram::fail(const std::string& what) {
  prints_.drain();
  kill();
  const std::string printed = prints_.last_lines();
  throw ProgramFault(
      "the program " + name_ + " " + what + (printed.empty() ? "" : "; it printed: " + printed),
      false);
}

int StartedProgram::kill() {
  if (pid_fd_ >= 0) ::close(std::exchange(pid_fd_, -1));
  return pid_ > 0 ? end_family(std::exchange(pid_, -1)) : 0;
}

}  // namespace avoidbench
