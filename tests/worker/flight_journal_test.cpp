#include "worker/flight_journal.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <cmath>
#include <fstream>
#include <string>

namespace avoidbench {
namespace {

Sample sample(double time_s) {
  Sample sample;
  sample.time_s = time_s;
  sample.position_world = {time_s, 1.0 / 3.0, -2.0};
  sample.velocity_world = sample.acceleration_world = sample.rates_body_radps = {1.0, 2.0, 3.0};
  sample.q_world_body = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  sample.reference_world = Eigen::Vector3d::Constant(std::nan(""));
  return sample;
}

/// Runs `work` on the worker's side of the journal, in a child, which then dies.
template <class Work>
int in_dying_worker(const FlightJournal& journal, Work&& work) {
  const int fd = ::dup(journal.fd());
  const pid_t child = ::fork();
  if (child == 0) {
    FlightJournal own(fd);
    own.restart();
    work(own);
    ::_exit(7);
  }
  ::close(fd);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

/// Where this process has the journal's pages that nobody may touch; null: nowhere.
volatile char* closed_pages() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("---s") == std::string::npos) continue;
    if (line.find("avoidbench_flight") == std::string::npos) continue;
    return reinterpret_cast<volatile char*>(std::stoull(line, nullptr, 16));
  }
  return nullptr;
}

TEST(FlightJournal, KeepsWhatADeadWorkerHadFlown) {
  const FlightJournal journal;
  in_dying_worker(journal, [](FlightJournal& own) {
    TrialRecord record;
    own.add(record, 0.0);
    record.samples = {sample(0.0), sample(0.02)};
    record.plan_calls.push_back({.time_s = 0.0, .cpu_time_s = 0.25, .command_kind = 2});
    own.add(record, 1.0 / 30.0);
    record.samples.push_back(sample(0.04));
    record.plan_calls.push_back({.time_s = 1.0 / 30.0, .wall_time_s = 0.5, .status = 1});
    record.collisions.push_back(
        {.time_s = 0.03, .speed_mps = 2.5, .obstacle = 4, .kind = "cylinder"});
    own.add(record, 2.0 / 30.0);
  });
  const auto flown = journal.flown();
  ASSERT_TRUE(flown.has_value());
  EXPECT_EQ(flown->end_time_s, 2.0 / 30.0);
  ASSERT_EQ(flown->samples.size(), 3U);
  EXPECT_EQ(flown->samples[2].position_world, sample(0.04).position_world);
  EXPECT_TRUE(std::isnan(flown->samples[1].reference_world.x()));
  ASSERT_EQ(flown->plan_calls.size(), 2U);
  EXPECT_EQ(flown->plan_calls[0].cpu_time_s, 0.25);
  EXPECT_EQ(flown->plan_calls[0].command_kind, 2U);
  EXPECT_TRUE(std::isnan(flown->plan_calls[1].latency_s));
  EXPECT_EQ(flown->plan_calls[1].status, 1);
  ASSERT_EQ(flown->collisions.size(), 1U);
  EXPECT_EQ(flown->collisions[0].kind, "cylinder");
  EXPECT_EQ(flown->collisions[0].obstacle, 4);
}

TEST(FlightJournal, IsEmptyBeforeTheFirstCallAndInANewTrial) {
  const FlightJournal journal;
  EXPECT_FALSE(journal.flown().has_value());
  in_dying_worker(journal, [](FlightJournal& own) {
    TrialRecord record;
    record.samples = {sample(0.0)};
    own.add(record, 0.5);
    own.restart();
  });
  EXPECT_FALSE(journal.flown().has_value());
}

TEST(FlightJournal, IsClosedToStrayWritesOfThePlanner) {
  const FlightJournal journal;
  const int status = in_dying_worker(journal, [](FlightJournal& own) {
    own.add(TrialRecord{}, 0.5);
    if (closed_pages() == nullptr) return;  // then the test fails below
    std::signal(SIGSEGV, SIG_DFL);          // sanitizers have a handler of their own
    *closed_pages() = 1;
  });
  EXPECT_TRUE(WIFSIGNALED(status)) << status;
  ASSERT_TRUE(journal.flown().has_value());
  EXPECT_EQ(journal.flown()->end_time_s, 0.5);
}

TEST(FlightJournal, DoesNotTakeRubbishForAFlight) {
  const FlightJournal journal;
  in_dying_worker(journal, [](FlightJournal& own) { own.add(TrialRecord{}, 0.5); });
  // As a planner could that opens the pages: lengths that lead beyond the memory.
  const std::uint64_t lengths[] = {~std::uint64_t{0}, FlightJournal::kBytes, 7};
  for (const std::uint64_t length : lengths) {
    ASSERT_EQ(::pwrite(journal.fd(), &length, sizeof length, 0), 8);
    const auto flown = journal.flown();
    EXPECT_TRUE(!flown || flown->samples.empty());
  }
  const std::uint32_t entry[] = {1, 0xffffffff};
  const std::uint64_t used = 8;
  ASSERT_EQ(::pwrite(journal.fd(), entry, sizeof entry, 16), 8);
  ASSERT_EQ(::pwrite(journal.fd(), &used, sizeof used, 0), 8);
  EXPECT_FALSE(journal.flown().has_value());
}

TEST(FlightJournal, WithoutMemoryNothingIsKeptAndNothingBreaks) {
  FlightJournal none(-1);
  none.restart();
  none.add(TrialRecord{}, 1.0);
  EXPECT_FALSE(none.flown().has_value());
}

TEST(FlightJournal, AFileThatIsNoJournalIsClosedToo) {
  const int fd = ::memfd_create("short", MFD_CLOEXEC);
  ASSERT_GE(fd, 0);
  FlightJournal none(fd);
  none.add(TrialRecord{}, 1.0);
  EXPECT_EQ(::fcntl(fd, F_GETFD), -1);
}

}  // namespace
}  // namespace avoidbench
