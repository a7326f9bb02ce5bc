#include "env/thread_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

namespace avoidbench {
namespace {

TEST(ThreadPool, DoesEachPieceOnce) {
  for (const std::size_t threads : {1U, 2U, 5U}) {
    ThreadPool pool(threads);
    for (const std::size_t count : {0U, 1U, 3U, 1000U}) {
      std::vector<std::atomic<int>> done(count);
      pool.for_each(count, [&](std::size_t piece) { ++done[piece]; });
      for (const auto& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(ThreadPool, ThrowsWhatTheLowestPieceThrewAfterAllAreDone) {
  ThreadPool pool(2);
  std::atomic<int> done = 0;
  const auto work = [&](std::size_t piece) {
    ++done;
    if (piece == 3 || piece == 60) throw std::runtime_error(std::to_string(piece));
  };
  for (int i = 0; i < 20; ++i) {
    done = 0;
    try {
      pool.for_each(100, work);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_EQ(done, 100);
  }
  pool.for_each(4, [&](std::size_t piece) { done += static_cast<int>(piece > 100); });
}

TEST(ThreadPool, APollThatThrowsLeavesTheRestUndone) {
  ThreadPool pool(2);
  std::atomic<int> done = 0;
  const auto work = [&](std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ++done;
  };
  const auto poll = [] { throw std::runtime_error("interrupted"); };
  EXPECT_THROW(pool.for_each(1000, work, poll), std::runtime_error);
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 1000);
  const int before = done;
  pool.for_each(2, work);
  EXPECT_EQ(done, before + 2);
}

}  // namespace
}  // namespace avoidbench
