#include "stop_signals.hpp"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <iostream>

#include "process/process_tree.hpp"

namespace avoidbench {
namespace {

StopSignals signals;

/// Runs at any moment: nothing here allocates or takes a lock.
void note_signal(int number, siginfo_t* info, void*) {
  const int error = errno;
  const bool is_sent = info->si_code <= 0 && info->si_pid > 0;  // by a process, not the kernel
  if (is_sent && descends_from(info->si_pid, ::getpid())) {
    ++signals.ignored;
  } else if (number == SIGHUP && signals.stop) {
    // The shell passes on the one that the terminal sends everybody: it counts once.
  } else if (!signals.stop.exchange(true) || !signals.stop_now.exchange(true)) {
    signals.number = number;
  } else {
    constexpr std::string_view kText = "ended at once; run the same command again to resume\n";
    // A terminal that was stopped must not hold up the end.
    pollfd ready{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (::poll(&ready, 1, 0) > 0) (void)!::write(STDERR_FILENO, kText.data(), kText.size());
    ::_exit(128 + number);
  }
  errno = error;
}

}  // namespace

const StopSignals& watch_stop_signals() {
  struct sigaction action {};
  action.sa_sigaction = note_signal;
  action.sa_flags = SA_SIGINFO;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU}) {
    struct sigaction before {};
    ::sigaction(number, &action, &before);
    // nohup's program goes on when its terminal goes away.
    if (number == SIGHUP && before.sa_handler == SIG_IGN) ::signal(number, SIG_IGN);
  }
  ::signal(SIGPIPE, SIG_IGN);  // whoever reads the messages may leave; rows are what counts
  ::signal(SIGIO, SIG_IGN);    // where a kernel's sandbox is too old to keep planners from it
  ::signal(SIGXFSZ, SIG_IGN);  // where `ulimit -f` ends a file, the write fails and says so
  return signals;
}

void end_stopped(const StopSignals& caught, std::string_view message) {
  constexpr int kExitStopped = 75, kExitInterrupted = 130;
  if (caught.number == SIGXCPU) std::cerr << "the limit of CPU time (ulimit -t) is reached: ";
  std::cerr << message << '\n';
  throw CLI::RuntimeError(caught.number == SIGINT ? kExitInterrupted : kExitStopped);
}

}  // namespace avoidbench
