#include "process/isolated_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace avoidbench {
namespace {

using testing::HasSubstr;

/// How it ended, within as many seconds as only a wait for the time limit would take.
IsolatedEnd soon(const std::function<void(IsolatedOutput&)>& work) {
  constexpr double kLimit_s = 60.0;
  const auto began = std::chrono::steady_clock::now();
  IsolatedEnd end = run_isolated(work, kLimit_s);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(),
            0.5 * kLimit_s);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no child is left
  EXPECT_EQ(errno, ECHILD);
  return end;
}

TEST(IsolatedRun, GivesBackWhatWasWritten) {
  const std::string bytes("a\0b\xff", 4);
  const IsolatedEnd end = soon([&](IsolatedOutput& output) {
    EXPECT_TRUE(output.write(bytes));
    EXPECT_TRUE(output.write(bytes));
    EXPECT_FALSE(output.write(std::string(IsolatedOutput::kMostBytes, 'x')));
  });
  EXPECT_EQ(end.problem, "");
  EXPECT_EQ(end.output, bytes + bytes);
}

TEST(IsolatedRun, HasRoomForAllThatItSays) {
  const std::string bytes(IsolatedOutput::kMostBytes - 1, 'x');
  const IsolatedEnd end = soon([&](IsolatedOutput& output) {
    EXPECT_TRUE(output.write(bytes));
    EXPECT_FALSE(output.write("yz"));
    EXPECT_TRUE(output.write("z"));
  });
  EXPECT_TRUE(end.output == bytes + "z");
}

TEST(IsolatedRun, AnExceptionEndsTheChildOnly) {
  const IsolatedEnd end =
      soon([](IsolatedOutput&) { throw std::runtime_error("out of the child"); });
  EXPECT_THAT(end.problem, HasSubstr("signal 6"));
  EXPECT_THAT(end.last_words, HasSubstr("out of the child"));
}

TEST(IsolatedRun, AnExitIsNoEnd) {
  const IsolatedEnd end = soon([](IsolatedOutput& output) {
    output.write("so far");
    std::puts("first line\nlast\tline \n");
    std::exit(3);
  });
  EXPECT_EQ(end.problem, "ended the process with code 3");
  EXPECT_EQ(end.output, "so far");
}

TEST(IsolatedRun, TheLastLineIsItsLastWords) {
  const IsolatedEnd end = soon([](IsolatedOutput&) {
    const std::string_view words = "first line\nlast\tline \n\n";
    (void)!::write(STDOUT_FILENO, words.data(), words.size());
    ::_exit(0);
  });
  EXPECT_EQ(end.problem, "ended the process with code 0");
  EXPECT_EQ(end.last_words, "last?line");
}

TEST(IsolatedRun, EndsAtItsTimeLimitWithAllThatItStarted) {
  const IsolatedEnd end = run_isolated(
      [](IsolatedOutput& output) {
        const pid_t child = ::fork();
        if (child == 0) ::setsid();
        if (child != 0) output.write(std::to_string(child));
        while (true) ::pause();
      },
      0.5);
  EXPECT_EQ(end.problem, "did not return within 0.5 s");
  EXPECT_EQ(::kill(std::stoi(end.output), 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST(IsolatedRun, WhatKillsItsWatcherIsNotWaitedFor) {
  const IsolatedEnd end = soon([](IsolatedOutput&) {
    ::kill(::getppid(), SIGKILL);
    while (true) ::pause();
  });
  EXPECT_THAT(end.problem, HasSubstr("ended the process that watches it"));
}

TEST(IsolatedRun, ASignalOfSomebodyElseIsNoTimeLimit) {
  for (const auto& [number, words] :
       {std::pair(SIGTERM, "signal 15 (Terminated)"), std::pair(SIGINT, "signal 2 (Interrupt)")}) {
    const IsolatedEnd end = soon([number = number](IsolatedOutput&) {
      ::kill(::getppid(), number);
      while (true) ::pause();
    });
    EXPECT_EQ(end.problem, std::string("was ended by ") + words + " from outside: run it again");
  }
}

TEST(IsolatedRun, ReachesNoDescriptorOfOurs) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const IsolatedEnd end = soon([&](IsolatedOutput& output) {
    output.write(::write(ends[1], "x", 1) == 1 ? "written" : "closed");
  });
  EXPECT_EQ(end.output, "closed");
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace avoidbench
