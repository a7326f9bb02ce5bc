#include "worker/worker_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <span>
#include <thread>
#include <utility>

#include "base/input_error.hpp"
#include "process/process_tree.hpp"
#include "program_planner/planner_source.hpp"
#include "worker/crash_report.hpp"
#include "worker/worker.hpp"

extern char** environ;  // NOLINT(readability-identifier-naming): POSIX's name

namespace avoidbench {
namespace {

// The first numbers after the standard streams. posix_spawn duplicates the pipes to them in the
// child, so that the child needs to be told nothing else.
constexpr int kJobFd = 3, kResultFd = 4, kNotesFd = 5, kJournalFd = 6;

constexpr int kAboveChild = kJournalFd + 5;

/// The C library picks variants of sin, exp, … by the processor; those with fused multiply-add
/// differ in the last bit. Planners use the C library, so workers run without those variants: the
/// same planner gives the same bits everywhere.
/// The names with _Usable are those of older versions of the C library.
constexpr const char* kTunables =
    "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-FMA_Usable,-FMA4_Usable";

/// The environment as it is, with the two variables set; pointers into `environ` and `python`,
/// which have to stay.
std::vector<char*> child_environment(std::string& python) {
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (std::strncmp(*variable, "GLIBC_TUNABLES=", 15) != 0) variables.push_back(*variable);
  }
  variables.push_back(const_cast<char*>(kTunables));
  if (!python.empty()) variables.push_back(python.data());
  variables.push_back(nullptr);
  return variables;
}

[[noreturn]] void fail(const char* what, int error) {
  throw InputError(std::string("can't start a worker process: ") + what + ": " +
                   std::strerror(error));
}

/// Both ends closed on exec, with numbers above those that the child's take.
struct Pipe {
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail("pipe", errno);
    // Else dup2() in the child could overwrite an end that it has yet to duplicate.
    read_end = ::fcntl(ends[0], F_DUPFD_CLOEXEC, kAboveChild);
    write_end = ::fcntl(ends[1], F_DUPFD_CLOEXEC, kAboveChild);
    ::close(ends[0]);
    ::close(ends[1]);
    if (read_end < 0 || write_end < 0) fail("pipe", errno);
  }
  ~Pipe() {
    if (read_end >= 0) ::close(read_end);
    if (write_end >= 0) ::close(write_end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take_read_end() { return std::exchange(read_end, -1); }
  int take_write_end() { return std::exchange(write_end, -1); }

  int read_end = -1, write_end = -1;
};

/// A copy of a descriptor above those that the child's take.
struct HighCopy {
  explicit HighCopy(int of) : fd(of < 0 ? -1 : ::fcntl(of, F_DUPFD_CLOEXEC, kAboveChild)) {}
  ~HighCopy() {
    if (fd >= 0) ::close(fd);
  }
  HighCopy(const HighCopy&) = delete;
  HighCopy& operator=(const HighCopy&) = delete;
  int fd;
};

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& command) {
  Pipe jobs, results, notes;
  job_fd_ = jobs.take_write_end();
  result_fd_ = results.take_read_end();
  notes_fd_ = notes.take_read_end();
  // One thread of the parent serves all workers: it must wait for none of them.
  for (const int fd : {job_fd_, result_fd_, notes_fd_}) ::fcntl(fd, F_SETFL, O_NONBLOCK);
  // The child must not hang on a parent that is busy: a lost sign of life is no harm.
  ::fcntl(notes.write_end, F_SETFL, O_NONBLOCK);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, jobs.read_end, kJobFd);
  posix_spawn_file_actions_adddup2(&actions, results.write_end, kResultFd);
  posix_spawn_file_actions_adddup2(&actions, notes.write_end, kNotesFd);
  const HighCopy journal(journal_.fd()), prints(prints_.fd());
  if (journal.fd >= 0) posix_spawn_file_actions_adddup2(&actions, journal.fd, kJournalFd);
  // The user's terminal is none of a planner's: neither to be read nor to be written to.
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    if (prints.fd >= 0) {
      posix_spawn_file_actions_adddup2(&actions, prints.fd, stream);
    } else {
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
    }
  }
  // A mask of signals is inherited, and so is what is ignored.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  ::sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  sigset_t ignored_here;
  ::sigemptyset(&ignored_here);
  // This process ignores them; planners start with the system's defaults.
  for (const int number : {SIGPIPE, SIGIO, SIGXFSZ}) ::sigaddset(&ignored_here, number);
  posix_spawnattr_setsigdefault(&attributes, &ignored_here);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<std::string> words = command;
  for (const int fd : {kJobFd, kResultFd, kNotesFd, journal.fd >= 0 ? kJournalFd : -1}) {
    words.push_back(std::to_string(fd));
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::string python = python_variable();
  std::vector<char*> variables = child_environment(python);
  const int error =
      ::posix_spawn(&pid_, arguments[0], &actions, &attributes, arguments.data(), variables.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    pid_ = -1;
    close_all();
    fail(words[0].c_str(), error);
  }
}

WorkerProcess::~WorkerProcess() {
  kill();
  close_all();
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      job_fd_(std::exchange(other.job_fd_, -1)),
      result_fd_(std::exchange(other.result_fd_, -1)),
      notes_fd_(std::exchange(other.notes_fd_, -1)),
      unsent_(std::move(other.unsent_)),
      inbox_(std::move(other.inbox_)),
      notes_(std::move(other.notes_)),
      was_heard_(other.was_heard_),
      prints_(std::move(other.prints_)),
      journal_(std::move(other.journal_)) {}

WorkerProcess& WorkerProcess::operator=(WorkerProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(job_fd_, other.job_fd_);
  std::swap(result_fd_, other.result_fd_);
  std::swap(notes_fd_, other.notes_fd_);
  std::swap(unsent_, other.unsent_);
  std::swap(inbox_, other.inbox_);
  std::swap(notes_, other.notes_);
  std::swap(was_heard_, other.was_heard_);
  std::swap(prints_, other.prints_);
  std::swap(journal_, other.journal_);
  return *this;
}

bool WorkerProcess::send(const Message& job, std::size_t most_answer_bytes, bool has_pieces) {
  prints_.restart();
  unsent_ = message_bytes(job);
  inbox_.expect(most_answer_bytes, has_pieces);
  return send_more();
}

/// As much as the pipe takes; the rest is sent when poll() says that it takes more.
bool WorkerProcess::send_more() {
  std::size_t done = 0;
  while (done < unsent_.size()) {
    const ssize_t written = ::write(job_fd_, unsent_.data() + done, unsent_.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN) break;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(done));
  return true;
}

WorkerProcess::Answer WorkerProcess::receive() {
  std::array<std::byte, 65536> bytes;
  MessageInbox::State state = inbox_.state();  // after a piece, what came with it
  // All that is there now.
  while (state == MessageInbox::State::incomplete) {
    const ssize_t got = ::read(result_fd_, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return Answer::incomplete;
    if (got <= 0) return Answer::gone;
    state = inbox_.add(std::span(bytes).first(static_cast<std::size_t>(got)));
  }
  return state == MessageInbox::State::whole ? Answer::whole : Answer::malformed;
}

bool WorkerProcess::listen() {
  // A crash report has some kilobytes. A planner that floods the pipe must not fill the parent's
  // memory.
  constexpr std::size_t kMostNotes = 65536;
  constexpr int kMostReads = 16;  // a planner may write here faster than this process reads
  std::array<char, 4096> bytes{};
  bool heard = false;
  for (int i = 0; i < kMostReads; ++i) {
    const ssize_t got = ::read(notes_fd_, bytes.data(), bytes.size());
    if (got <= 0) return heard;
    heard = was_heard_ = true;
    for (const char byte : std::span(bytes).first(static_cast<std::size_t>(got))) {
      // Zeros are signs of life, the rest is a crash report.
      if (byte != 0 && notes_.size() < kMostNotes) notes_ += byte;
    }
  }
  return heard;
}

bool WorkerProcess::has_ended() const {
  // WNOWAIT leaves the status for wait().
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid_;
}

bool WorkerProcess::go_on() { return is_stopped_process(pid_) && ::kill(pid_, SIGCONT) == 0; }

int WorkerProcess::ended_within(double seconds) {
  // waitpid() has no time limit of its own.
  constexpr int kLook_ms = 5;
  int status = 0;
  for (int waited_ms = 0; ::waitpid(pid_, &status, WNOHANG) == 0; waited_ms += kLook_ms) {
    if (waited_ms > 1000.0 * seconds) return -1;
    std::this_thread::sleep_for(std::chrono::milliseconds(kLook_ms));
  }
  pid_ = -1;
  return status;
}

ProcessEnd WorkerProcess::wait() {
  // Its pipe is closed but it lives: a second for a process that is just about to end.
  const int status = ended_within(1.0);
  if (status < 0) {
    kill();
    return {.text = "its pipes were broken", .exit_code = kPipesExitCode, .signal = 0};
  }
  listen();
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return {.text = "signal " + std::to_string(number) + " (" + ::strsignal(number) + ")",
            .exit_code = -1,
            .signal = number,
            .is_of_others = !was_heard_ || is_marked_from_outside(notes_, number)};
  }
  const int code = WEXITSTATUS(status);
  std::string text = "exit code " + std::to_string(code);
  if (!was_heard_) text += " before it was ready: " + last_line_of(prints_.text());
  return {.text = std::move(text),
          .exit_code = code,
          .signal = 0,
          .is_of_others = !was_heard_ && code != kSandboxExitCode};
}

void WorkerProcess::kill() {
  if (pid_ <= 0) return;
  constexpr double kMostTime_s = 10.0;  // some calls of the kernel can't be interrupted
  ::kill(pid_, SIGKILL);
  if (ended_within(kMostTime_s) < 0) pid_ = -1;  // its end is somebody else's to see
}

void WorkerProcess::close_all() {
  for (int* fd : {&job_fd_, &result_fd_, &notes_fd_}) {
    if (*fd >= 0) ::close(*fd);
    *fd = -1;
  }
}

}  // namespace avoidbench
