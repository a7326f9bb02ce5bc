#include "process/process_tree.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace avoidbench {
namespace {

/// Waits for something that another process does.
template <class Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 500 && !condition(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return condition();
}

/// A child that has a child of its own, both asleep; the inner one in a session of its own.
pid_t start_family() {
  const pid_t child = ::fork();
  if (child != 0) return child;
  if (::fork() == 0) ::setsid();
  while (true) ::pause();
}

TEST(ProcessTree, OrphansOfOrphansAreEndedAndOthersSpared) {
  adopt_orphans();
  const pid_t other = ::fork();
  if (other == 0) {
    while (true) ::pause();
  }
  const pid_t first = start_family();
  ASSERT_TRUE(comes_true([&] { return own_children().contains(first); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::kill(first, SIGKILL);
  ::waitpid(first, nullptr, 0);
  ASSERT_TRUE(comes_true([] { return own_children().size() == 2; }));  // the inner one is ours now
  EXPECT_EQ(end_orphans({other}), 1);
  EXPECT_EQ(own_children(), std::set<pid_t>{other});
  EXPECT_EQ(end_orphans({}), 1);
  EXPECT_FALSE(has_children());
}

/// A child that has a child of its own, which is killed as soon as its parent ends.
pid_t start_bound_family() {
  int ends[2];
  if (::pipe(ends) != 0) return -1;
  const pid_t child = ::fork();
  if (child == 0) {
    if (::fork() == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      // Memory takes the kernel a while to take back.
      std::string filled(std::size_t{16} << 20U, 'x');
      (void)!::write(ends[1], filled.data(), 1);
    }
    while (true) ::pause();
  }
  char ready = 0;
  (void)!::read(ends[0], &ready, 1);
  ::close(ends[0]);
  ::close(ends[1]);
  return child;
}

TEST(ProcessTree, WhatIsKilledWithItsParentIsNotLeftBehind) {
  adopt_orphans();
  int left_behind = 0;
  for (int i = 0; i < 50; ++i) {
    const pid_t child = start_bound_family();
    ASSERT_GT(child, 0);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    left_behind += end_orphans({});
  }
  EXPECT_EQ(left_behind, 0);
  EXPECT_FALSE(has_children());
}

/// Each of them starts two more, as fast as it can.
TEST(ProcessTree, WhatMultipliesIsEnded) {
  adopt_orphans();
  const pid_t first = ::fork();
  if (first == 0) {
    for (int i = 0; i < 6; ++i) {
      ::fork();
      ::usleep(2000);
    }
    while (true) ::pause();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GE(end_orphans({}), 1);
  EXPECT_FALSE(has_children());
}

TEST(ProcessTree, KnowsWhoDescendsFromWhom) {
  const pid_t child = ::fork();
  if (child == 0) {
    while (true) ::pause();
  }
  EXPECT_TRUE(descends_from(child, ::getpid()));
  EXPECT_FALSE(descends_from(::getppid(), ::getpid()));
  EXPECT_FALSE(descends_from(1, ::getpid()));
  EXPECT_FALSE(is_stopped_process(child));
  ::kill(child, SIGSTOP);
  EXPECT_TRUE(comes_true([&] { return is_stopped_process(child); }));
  EXPECT_EQ(end_orphans({}), 1);
}

TEST(ProcessTree, MemoryOfChildrenCounts) {
  constexpr std::size_t kBytes = std::size_t{200} << 20U;
  const double alone_mib = resident_mib_of_family();
  const pid_t child = ::fork();
  if (child == 0) {
    std::string filled(kBytes, 'x');
    volatile char last = filled.back();
    while (last != 0) ::pause();
  }
  EXPECT_TRUE(comes_true([&] { return resident_mib_of_family() > alone_mib + 150.0; }));
  end_orphans({});
  EXPECT_LT(resident_mib_of_family(), alone_mib + 100.0);
}

TEST(ProcessTree, ThreadsThatShareAProcessorWaitForIt) {
  if (processor_waits_ns().empty()) GTEST_SKIP() << "the kernel does not count it";
  cpu_set_t one, all;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(::sched_getcpu()), &one);
  const pid_t child = ::fork();
  if (child == 0) {
    ::sched_setaffinity(0, sizeof one, &one);
    for (volatile int i = 0;;) i = i + 1;
  }
  ::sched_setaffinity(0, sizeof one, &one);
  const auto began = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - began < std::chrono::milliseconds(500)) {
  }
  const auto waits_ns = processor_waits_ns();
  ::sched_setaffinity(0, sizeof all, &all);
  end_family(child);
  ASSERT_TRUE(waits_ns.contains(::gettid()));
  ASSERT_TRUE(waits_ns.contains(child));
  // A fair scheduler gives each half.
  EXPECT_GT(waits_ns.at(::gettid()) + waits_ns.at(child), 100'000'000U);
}

}  // namespace
}  // namespace avoidbench
