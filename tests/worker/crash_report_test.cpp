#include "worker/crash_report.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <string>

/// Whether a signal that ended a process was its own doing.
namespace avoidbench {
namespace {

constexpr std::array kSignals{SIGSEGV, SIGBUS,  SIGFPE,    SIGILL,  SIGABRT, SIGQUIT, SIGALRM,
                              SIGTRAP, SIGXCPU, SIGVTALRM, SIGPROF, SIGUSR2, SIGSYS};

struct End {
  int signal = 0;
  std::string report;
};

/// A process that reports its crashes, runs `work` and then waits; `sent` is sent to it when it has
/// come so far.
End end_of(const std::function<void()>& work, int sent = 0) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    report_crashes(ends[1]);
    (void)!::write(ends[1], "ready\n", 6);
    work();
    while (true) ::pause();
  }
  ::close(ends[1]);
  End end;
  std::array<char, 4096> bytes{};
  while (end.report.find("ready") == std::string::npos) {
    const ssize_t count = ::read(ends[0], bytes.data(), bytes.size());
    if (count <= 0) break;
    end.report.append(bytes.data(), static_cast<std::size_t>(count));
  }
  if (sent != 0) ::kill(child, sent);
  int status = 0;
  ::waitpid(child, &status, 0);
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  while (true) {
    const ssize_t count = ::read(ends[0], bytes.data(), bytes.size());
    if (count <= 0) break;
    end.report.append(bytes.data(), static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  return end;
}

TEST(CrashReport, MarksWhatSomebodyElseSent) {
  for (const int number : kSignals) {
    const End end = end_of([] {}, number);
    EXPECT_EQ(end.signal, number);
    EXPECT_TRUE(is_marked_from_outside(end.report, number)) << number << ": " << end.report;
    EXPECT_FALSE(is_marked_from_outside(end.report, SIGTERM));
  }
}

TEST(CrashReport, DoesNotMarkWhatTheProcessDidToItself) {
  for (const int number : kSignals) {
    const End end = end_of([number] { ::raise(number); });
    EXPECT_EQ(end.signal, number);
    EXPECT_FALSE(is_marked_from_outside(end.report, number)) << number << ": " << end.report;
  }
  const End aborted = end_of([] { std::abort(); });
  EXPECT_EQ(aborted.signal, SIGABRT);
  EXPECT_FALSE(is_marked_from_outside(aborted.report, SIGABRT));
  const End alarmed = end_of([] { ::alarm(1); });
  EXPECT_EQ(alarmed.signal, SIGALRM);
  EXPECT_FALSE(is_marked_from_outside(alarmed.report, SIGALRM));
  const End by_child = end_of([] {
    const pid_t parent = ::getpid();
    if (::fork() == 0) {
      ::kill(parent, SIGSEGV);
      ::_exit(0);
    }
  });
  EXPECT_EQ(by_child.signal, SIGSEGV);
  EXPECT_FALSE(is_marked_from_outside(by_child.report, SIGSEGV));
}

/// Uses CPU time for ever.
[[noreturn]] void work_for_ever() {
  volatile bool forever = true;
  while (forever) {
  }
  std::abort();
}

TEST(CrashReport, MarksALimitOfCpuTime) {
  const End end = end_of([] {
    rlimit limit{};
    ::getrlimit(RLIMIT_CPU, &limit);
    limit.rlim_cur = 1;
    ::setrlimit(RLIMIT_CPU, &limit);
    work_for_ever();
  });
  EXPECT_EQ(end.signal, SIGXCPU);
  EXPECT_TRUE(is_marked_from_outside(end.report, SIGXCPU));
}

}  // namespace
}  // namespace avoidbench
