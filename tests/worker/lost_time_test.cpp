#include "worker/lost_time.hpp"

#include <gtest/gtest.h>

namespace avoidbench {
namespace {

constexpr double kLook_s = 0.1;
using Waits = std::map<pid_t, std::uint64_t>;

TEST(LostTime, NothingOnAnIdleMachine) {
  LostTime lost;
  for (int i = 1; i <= 100; ++i) EXPECT_EQ(lost.in_call_s(kLook_s * i, kLook_s, {{7, 5}}), 0.0);
}

TEST(LostTime, AThreadThatWaitsHalfTheTimeLosesHalf) {
  LostTime lost;
  std::uint64_t waited_ns = 1'000'000'000'000;  // of earlier calls: not of this one
  double lost_s = 0.0;
  for (int i = 1; i <= 100; ++i) {
    lost_s = lost.in_call_s(kLook_s * i, kLook_s, {{7, waited_ns}, {8, 3}});
    waited_ns += 50'000'000;
  }
  EXPECT_NEAR(lost_s, 99 * 0.05, 1e-9);
  EXPECT_NEAR(lost.in_call_s(0.05, kLook_s, {{7, waited_ns}}), 0.9 * 0.05, 1e-9) << "a new call";
}

TEST(LostTime, NewAndEndedThreadsCountFromTheirSecondLook) {
  LostTime lost;
  lost.in_call_s(1.0, kLook_s, {{7, 0}});
  EXPECT_EQ(lost.in_call_s(1.1, kLook_s, {{8, 90'000'000}}), 0.0);
  EXPECT_EQ(lost.in_call_s(1.2, kLook_s, {{8, 10}}), 0.0) << "its number was given again";
  EXPECT_NEAR(lost.in_call_s(1.3, kLook_s, {{8, 20'000'010}}), 0.02, 1e-12);
}

TEST(LostTime, ThreadsThatKeepEachOtherWaitingEndAtTenTimesTheLimit) {
  LostTime lost;
  std::uint64_t waited_ns = 0;
  for (int i = 1; i <= 1000; ++i) {
    const double call_s = kLook_s * i;
    waited_ns += 100'000'000;
    EXPECT_GE(call_s - lost.in_call_s(call_s, kLook_s, {{7, waited_ns}}), 0.1 * call_s - 1e-9);
  }
}

TEST(LostTime, AStoppedProcessLosesTheWholeGapOnce) {
  LostTime lost;
  lost.in_call_s(2.0, kLook_s, {{7, 0}});
  EXPECT_NEAR(lost.in_call_s(62.0, 60.0, {{7, 60'000'000'000}}), 60.0, 1e-9);
  EXPECT_NEAR(lost.in_call_s(62.1, kLook_s, {{7, 60'000'000'000}}), 60.0, 1e-9);
}

}  // namespace
}  // namespace avoidbench
