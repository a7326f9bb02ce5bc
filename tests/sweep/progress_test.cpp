#include <cstdint>
#include <utility>

#include "support/small_sweep.hpp"

namespace avoidbench {
namespace {

using ProgressReports = test::SweepTest;

/// In this process, only changes are told: the beginning, two maps and eight trials. Workers are
/// waited for in turns, at least one for each of their ten jobs, so that times go on in between.
TEST_F(ProgressReports, ComeAtEachTurnAndNotOnlyAtChanges) {
  int count = 0;
  std::int64_t done = 0;
  options_.on_progress = [&](const Progress& progress) {
    ++count;
    EXPECT_GE(progress.done, done);
    EXPECT_EQ(progress.total, 8);
    done = progress.done;
  };
  run(test::small_sweep(), "in_process.db", 1, true);
  EXPECT_EQ(done, 8);
  const int changes = std::exchange(count, 0);
  done = 0;
  run(test::small_sweep(), "in_workers.db", 1);
  EXPECT_EQ(done, 8);
  EXPECT_GE(count, changes + 10);
}

}  // namespace
}  // namespace avoidbench
