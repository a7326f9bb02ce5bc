#include "worker/worker_process.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <cerrno>
#include <utility>

namespace avoidbench {
namespace {

/// The shell, which ignores what a worker needs.
WorkerProcess shell(const std::string& script) { return WorkerProcess({"/bin/sh", "-c", script}); }

TEST(WorkerProcess, ItsEndIsToldInWords) {
  const ProcessEnd early = shell("echo hello; exit 3").wait();
  EXPECT_EQ(early.text, "exit code 3 before it was ready: hello");
  EXPECT_EQ(early.exit_code, 3);
  EXPECT_EQ(early.signal, 0);
  EXPECT_TRUE(early.is_of_others);  // no planner was there yet
  const ProcessEnd ended = shell("printf x >&5; exit 3").wait();
  EXPECT_EQ(ended.text, "exit code 3");
  EXPECT_FALSE(ended.is_of_others);
  const ProcessEnd killed = shell("printf x >&5; kill -9 $$").wait();
  EXPECT_EQ(killed.text, "signal 9 (Killed)");
  EXPECT_EQ(killed.exit_code, -1);
  EXPECT_EQ(killed.signal, SIGKILL);
  EXPECT_FALSE(killed.is_of_others);  // nobody noted that somebody else sent it
  EXPECT_TRUE(shell("kill -9 $$").wait().is_of_others);
}

TEST(WorkerProcess, OneThatBreaksItsPipesIsKilled) {
  const ProcessEnd end = shell("printf x >&5; exec 3>&- 4>&- 5>&-; sleep 60").wait();
  EXPECT_EQ(end.text, "its pipes were broken");
  EXPECT_FALSE(end.is_of_others);
}

TEST(WorkerProcess, AnEndWithoutMoreIsNobodyElses) { EXPECT_FALSE(ProcessEnd{}.is_of_others); }

TEST(WorkerProcess, IsEndedByItsLastOwnerAlone) {
  pid_t pid = -1;
  {
    WorkerProcess owner = shell("sleep 60");
    pid = owner.pid();
    {
      WorkerProcess first(std::move(owner));
      EXPECT_EQ(owner.pid(), -1);  // NOLINT(bugprone-use-after-move): what is left behind
      owner = std::move(first);
      EXPECT_EQ(first.pid(), -1);  // NOLINT(bugprone-use-after-move)
    }
    EXPECT_EQ(owner.pid(), pid);
    EXPECT_FALSE(owner.has_ended());
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_EQ(::kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST(WorkerProcess, AStoppedOneGoesOn) {
  WorkerProcess process = shell("sleep 60");
  EXPECT_FALSE(process.go_on());
  ASSERT_EQ(::kill(process.pid(), SIGSTOP), 0);
  bool went_on = false;
  for (int i = 0; i < 1'000'000 && !went_on; ++i) went_on = process.go_on();
  EXPECT_TRUE(went_on);
}

TEST(WorkerProcess, AProgramThatIsNotThereIsAnError) {
  EXPECT_ANY_THROW(WorkerProcess({"/nowhere/avoidbench"}));
}

}  // namespace
}  // namespace avoidbench
