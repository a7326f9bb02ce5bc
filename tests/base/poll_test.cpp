#include "base/poll.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

TEST(Poll, WithoutAScopeNothingIsCalled) {
  EXPECT_FALSE(is_polled());
  poll_caller();
}

TEST(Poll, IsCalledAtOnceAndThenNowAndThen) {
  int polls = 0;
  const PollScope scope([&polls] { ++polls; });
  EXPECT_TRUE(is_polled());
  poll_caller();
  EXPECT_EQ(polls, 1);
  const auto began = Clock::now();
  std::int64_t calls = 0;
  while (polls < 4) {
    poll_caller();
    ++calls;
  }
  EXPECT_GE(Clock::now() - began, std::chrono::milliseconds(29));
  EXPECT_GT(calls, 100);
}

TEST(Poll, TheNewestScopeCountsUntilItEnds) {
  int outer = 0, inner = 0;
  const PollScope scope([&outer] { ++outer; });
  {
    const PollScope newer([&inner] { ++inner; });
    poll_caller();
  }
  EXPECT_EQ(inner, 1);
  EXPECT_EQ(outer, 0);
  poll_caller();
  EXPECT_EQ(outer, 1);
}

TEST(Poll, AScopeIsOfItsThread) {
  int polls = 0;
  const PollScope scope([&polls] { ++polls; });
  std::thread([] {
    EXPECT_FALSE(is_polled());
    poll_caller();
  }).join();
  EXPECT_EQ(polls, 0);
}

TEST(Poll, WhatItThrowsEndsTheWork) {
  {
    const PollScope scope([] { throw std::runtime_error("enough"); });
    EXPECT_THROW(poll_caller(), std::runtime_error);
  }
  EXPECT_FALSE(is_polled());
}

}  // namespace
}  // namespace avoidbench
