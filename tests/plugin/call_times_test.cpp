#include "plugin/call_times.hpp"

#include <gtest/gtest.h>

namespace avoidbench {
namespace {

constexpr double kPeriod_s = 1.0 / 30.0, kLatency_s = 0.033;

TEST(CallTimes, ASleepingPlannerIsLateAndHidesItsTime) {
  const CallTimes times{.count = 579, .late_count = 548, .wall_s = 0.097, .cpu_s = 0.00005};
  EXPECT_EQ(
      lateness(times, kPeriod_s, kLatency_s),
      "548 of 579 calls took longer than the plan period of 33.3 ms (wall time of one 97 ms)");
  EXPECT_EQ(hidden_time(times).rfind("calls took 97 ms of wall time, but 0.05 ms of CPU "
                                     "time",
                                     0),
            0U)
      << hidden_time(times);
}

TEST(CallTimes, LatencyIsJudgedWherePeriodsAreKept) {
  const CallTimes times{.count = 100, .late_count = 0, .wall_s = 0.02, .cpu_s = 0.02};
  EXPECT_EQ(lateness(times, kPeriod_s, 0.01),
            "calls took 20 ms of wall time, longer than the latency of 10 ms");
  EXPECT_EQ(lateness(times, kPeriod_s, kLatency_s), "");
  EXPECT_EQ(lateness(times, kPeriod_s, 0.0), "");  // no demand
  EXPECT_EQ(hidden_time(times), "");
}

TEST(CallTimes, ABusyMachineIsNoWarning) {
  EXPECT_EQ(lateness({.count = 100, .late_count = 5, .wall_s = 0.01, .cpu_s = 0.005}, kPeriod_s,
                     kLatency_s),
            "");
  EXPECT_EQ(hidden_time({.count = 100, .wall_s = 0.01, .cpu_s = 0.005}), "");
  EXPECT_EQ(hidden_time({.count = 100, .wall_s = 0.0029, .cpu_s = 0.0001}), "");
  EXPECT_EQ(lateness({}, kPeriod_s, kLatency_s), "");
  EXPECT_EQ(hidden_time({}), "");
}

}  // namespace
}  // namespace avoidbench
