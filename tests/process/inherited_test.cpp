#include "process/inherited.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace avoidbench {
namespace {

int exit_code_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool is_open(int fd) { return ::fcntl(fd, F_GETFD) >= 0; }

TEST(Inherited, DescriptorsAreClosedFromANumberOn) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int last_kept = ::dup2(STDERR_FILENO, 20), first = ::dup2(STDERR_FILENO, 21),
              high = ::dup2(STDERR_FILENO, 1000);
    if (!is_open(last_kept) || !is_open(first) || !is_open(high)) ::_exit(2);
    close_from(first);
    ::_exit(is_open(last_kept) && !is_open(first) && !is_open(high) ? 0 : 1);
  }
  EXPECT_EQ(exit_code_of(child), 0);
}

/// A child of the process that has the terminal, as a worker is one of the run.
TEST(Inherited, TheTerminalIsLeftAndTheGroupIsNot) {
  int control = -1;
  const pid_t run = ::forkpty(&control, nullptr, nullptr, nullptr);
  if (run == 0) {
    const pid_t worker = ::fork();
    if (worker == 0) {
      if (::open("/dev/tty", O_RDWR) < 0) ::_exit(2);
      leave_terminal();
      const bool is_gone = ::open("/dev/tty", O_RDONLY) < 0 && errno == ENXIO;
      ::_exit(is_gone && ::getpgrp() == ::getppid() ? 0 : 1);
    }
    ::_exit(exit_code_of(worker));
  }
  EXPECT_EQ(exit_code_of(run), 0);
  ::close(control);
}

}  // namespace
}  // namespace avoidbench
