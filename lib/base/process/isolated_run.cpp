#include "process/isolated_run.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "process/inherited.hpp"
#include "process/process_tree.hpp"

// Three processes: the parent, which waits; the watcher, which adopts and kills all that the worker
// leaves behind; and the worker, which does the work.
namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

/// What the parent waits beyond the time limit for a watcher that a planner stopped.
constexpr double kWatcherSlack_s = 2.0;
/// How long the watcher tries to kill processes that multiply.
constexpr double kKilling_s = 2.0;

/// What the watcher reports.
struct Verdict {
  int status = 0;  ///< as waitpid gives it; of no meaning unless in_time
  bool in_time = false;
  int ended_by = 0;    ///< not 0: a signal that somebody else sent to the watcher ended it
  int fork_error = 0;  ///< not 0: there was no process for the work
};

[[noreturn]] void fail(const char* what, int error) {
  throw InputError(std::string("can't start a process to load a planner in: ") + what + ": " +
                   std::strerror(error));
}

double seconds_until(Clock::time_point end) {
  return std::chrono::duration<double>(end - Clock::now()).count();
}

Clock::time_point after(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

struct Pipe {
  explicit Pipe(int flags) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC | flags) != 0) fail("pipe", errno);
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Pipe() {
    ::close(read_end);
    close_write_end();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_write_end() {
    if (write_end >= 0) ::close(std::exchange(write_end, -1));
  }

  int read_end = -1, write_end = -1;
};

/// All signals blocked for as long as it lives, so that no handler runs in a child of a fork.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

/// Neither the caller's handlers nor what it has blocked holds for the work.
void use_default_signals() {
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// An exit() in a planner must not run what this program registered for its own end.
void leave_at_once(int code, void*) { ::_exit(code); }

/// Cuts the calling process off from its parent's session, files, streams and signal handlers. What
/// it prints goes to `words_fd`.
void cut_off(int words_fd) {
  // Out of the terminal's foreground group: Ctrl-C reaches the parent only, which then ends the
  // rest.
  ::setsid();
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(words_fd, STDOUT_FILENO);
  ::dup2(words_fd, STDERR_FILENO);
  close_from(STDERR_FILENO + 1);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int oom = ::open("/proc/self/oom_score_adj", O_WRONLY);
  if (oom >= 0) {  // if memory runs out: this process first
    [[maybe_unused]] const ssize_t written = ::write(oom, "1000", 4);
    ::close(oom);
  }
  use_default_signals();
  ::on_exit(leave_at_once, nullptr);
}

/// The process of the work: cut off from the caller's before it begins, and ended by _exit().
[[noreturn]] void be_worker(const std::function<void(IsolatedOutput&)>& work,
                            IsolatedOutput& output, int words_fd, pid_t watcher) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The parent may have ended before the death signal was set.
  if (::getppid() != watcher) ::_exit(1);
  cut_off(words_fd);
  output.claim();
  work(output);
  output.finish();
  ::_exit(0);
}

/// Kills the worker, which was not waited for yet, and all its descendants, which are the watcher's
/// children as soon as their own parents are gone. Returns the worker's status.
int kill_all(pid_t worker) {
  ::kill(worker, SIGKILL);
  int status = 0;
  while (::waitpid(worker, &status, 0) < 0 && errno == EINTR) {
  }
  end_orphans({}, kKilling_s);
  return status;
}

/// Without reaping it: until then its number is given to no other process.
bool has_ended(pid_t worker) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(worker), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == worker;
}

/// The watcher's last act.
[[noreturn]] void report(const Verdict& verdict, const Pipe& verdicts) noexcept {
  [[maybe_unused]] const ssize_t written = ::write(verdicts.write_end, &verdict, sizeof verdict);
  ::_exit(0);
}

/// Between the caller and the worker: waits for the worker's end or the time limit, ends all that
/// the worker has left behind, and says how it went.
[[noreturn]] void be_watcher(const std::function<void(IsolatedOutput&)>& work,
                             IsolatedOutput& output, double time_limit_s, const Pipe& verdicts,
                             int words_fd, pid_t parent) noexcept {
  const Clock::time_point end = after(time_limit_s);
  // A caller may ignore it, and its children would then leave no status.
  ::signal(SIGCHLD, SIG_DFL);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  adopt_orphans();
  if (::getppid() != parent) ::_exit(1);
  const pid_t watcher = ::getpid();
  const pid_t worker = ::fork();
  if (worker == 0) be_worker(work, output, words_fd, watcher);
  if (worker < 0) report({.fork_error = errno}, verdicts);
  Verdict verdict;

  sigset_t awaited;
  ::sigemptyset(&awaited);
  for (const int number : {SIGCHLD, SIGTERM, SIGINT, SIGHUP, SIGQUIT})
    ::sigaddset(&awaited, number);
  while (!verdict.in_time) {
    const double left_s = seconds_until(end);
    if (left_s <= 0.0) break;
    const double whole_s = std::floor(left_s);
    const timespec left{static_cast<time_t>(whole_s), static_cast<long>(1e9 * (left_s - whole_s))};
    // Signals were blocked before the fork, so that none is lost between looks.
    const int signal = ::sigtimedwait(&awaited, nullptr, &left);
    if (signal > 0 && signal != SIGCHLD) {
      verdict.ended_by = signal;
      break;
    }
    verdict.in_time = has_ended(worker);
  }
  // In any case: what the worker has left behind goes with it.
  verdict.status = kill_all(worker);
  report(verdict, verdicts);
}

std::string signal_text(int number) {
  return "signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
}

std::string ending(const Verdict& verdict, double time_limit_s) {
  if (verdict.fork_error != 0) {
    return std::string("could not start a process: ") + std::strerror(verdict.fork_error) +
           " (see ulimit -u and free memory)";
  }
  if (verdict.ended_by != 0) {
    return "was ended by " + signal_text(verdict.ended_by) + " from outside: run it again";
  }
  if (!verdict.in_time) {
    char text[64];
    std::snprintf(text, sizeof text, "did not return within %g s", time_limit_s);
    return text;
  }
  if (WIFSIGNALED(verdict.status)) {
    return "crashed by " + signal_text(WTERMSIG(verdict.status));
  }
  return "ended the process with code " + std::to_string(WEXITSTATUS(verdict.status));
}

/// The last line in what was printed that has anything to read.
std::string last_line(int words_fd) {
  constexpr std::size_t kMostBytes = 65536, kMostShown = 200;
  // What a full pipe holds; the rest was lost when the pipe did not take it.
  std::string words(kMostBytes, '\0');
  const ssize_t count = ::read(words_fd, words.data(), words.size());
  words.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  const std::size_t last = words.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return "";
  words.resize(last + 1);
  const std::size_t line_end = words.rfind('\n');
  if (line_end != std::string::npos) words.erase(0, line_end + 1);
  if (words.size() > kMostShown) words.resize(kMostShown);
  for (char& c : words) c = c >= 0x20 && c < 0x7f ? c : '?';
  return words;
}

}  // namespace

struct IsolatedOutput::Shared {
  std::atomic<std::size_t> size{0};
  std::atomic<bool> is_finished{false};
  std::array<char, kMostBytes> bytes;
};

IsolatedOutput::IsolatedOutput() {
  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) fail("mmap", errno);
  shared_ = new (memory) Shared;  // its bytes are zero already, and not touched
}

IsolatedOutput::~IsolatedOutput() { ::munmap(shared_, sizeof(Shared)); }

void IsolatedOutput::claim() {
  // Closed while planner code runs: a stray write then crashes instead of changing the answer.
  owner_ = ::getpid();
  ::mprotect(shared_, sizeof(Shared), PROT_NONE);
}

bool IsolatedOutput::write(std::string_view bytes) {
  // A child that planner code forked has no say.
  if (::getpid() != owner_) ::_exit(0);
  if (bytes.size() > kMostBytes - written_) return false;
  ::mprotect(shared_, sizeof(Shared), PROT_READ | PROT_WRITE);
  std::copy(bytes.begin(), bytes.end(), shared_->bytes.begin() + written_);
  written_ += bytes.size();
  shared_->size = written_;
  ::mprotect(shared_, sizeof(Shared), PROT_NONE);
  return true;
}

void IsolatedOutput::finish() {
  if (::getpid() != owner_) ::_exit(0);
  ::mprotect(shared_, sizeof(Shared), PROT_READ | PROT_WRITE);
  shared_->is_finished = true;
}

bool IsolatedOutput::is_finished() const { return shared_->is_finished; }

std::string IsolatedOutput::bytes() const {
  return {shared_->bytes.data(), std::min(shared_->size.load(), kMostBytes)};
}

IsolatedEnd run_isolated(const std::function<void(IsolatedOutput&)>& work, double time_limit_s,
                         Prints prints) {
  IsolatedOutput output;
  Pipe verdicts(0), words(O_NONBLOCK);
  const int words_fd = prints == Prints::kept ? words.write_end : STDERR_FILENO;
  std::fflush(nullptr);  // so that the child has nothing of ours to print
  pid_t watcher = -1;
  {
    const SignalsBlocked blocked;
    const pid_t parent = ::getpid();
    watcher = ::fork();
    if (watcher == 0) {
      be_watcher(work, output, time_limit_s, verdicts, words_fd, parent);
    }
    if (watcher < 0) fail("fork", errno);
  }
  // Only the watcher's end is left: the pipe ends with it.
  verdicts.close_write_end();
  words.close_write_end();

  Verdict verdict;
  bool is_reported = false, is_over = false;
  const Clock::time_point end = after(time_limit_s + kKilling_s + kWatcherSlack_s);
  while (!is_over && seconds_until(end) > 0.0) {
    pollfd waiting{verdicts.read_end, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(1000.0 * seconds_until(end)) + 1) <= 0) continue;
    is_over = true;
    is_reported = ::read(verdicts.read_end, &verdict, sizeof verdict) == sizeof verdict;
  }
  // A watcher that a planner has stopped or killed.
  if (!is_reported) ::kill(watcher, SIGKILL);
  // Always waited for: a caller may fork again at once, and must find no zombie of ours.
  while (::waitpid(watcher, nullptr, 0) < 0 && errno == EINTR) {
  }
  IsolatedEnd result{.output = output.bytes(), .problem = "", .last_words = ""};
  if (is_over && !is_reported) {
    result.problem = "ended the process that watches it (or somebody else did: run it again)";
  } else if (!verdict.in_time || verdict.status != 0 || !output.is_finished()) {
    result.problem = ending(verdict, time_limit_s);
  }
  if (!result.problem.empty()) result.last_words = last_line(words.read_end);
  return result;
}

}  // namespace avoidbench
