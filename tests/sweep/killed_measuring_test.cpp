#include <fstream>

#include "support/small_sweep.hpp"

namespace avoidbench {
namespace {

/// Workers of which the first few are killed: as soon as a job has come, the first of which
/// measures a map, or before they take any.
class KilledMeasuring : public test::SweepTest {
 protected:
  void kill_first(int count, const std::string& when = "head -c 1 <&3 >/dev/null") {
    const std::filesystem::path script = folder_ / "worker.sh", killed = folder_ / "killed";
    std::ofstream(script) << "#!/bin/sh\n"
                          << "n=$(cat '" << killed.string() << "' 2>/dev/null || echo 0)\n"
                          << "if [ $n -lt " << count << " ]; then\n"
                          << "  " << when << "\n"
                          << "  echo $((n + 1)) >'" << killed.string() << "'\n"
                          << "  kill -KILL $$\n"
                          << "fi\n"
                          << "exec \"$@\"\n";
    options_.worker_command.insert(options_.worker_command.begin(), {"/bin/sh", script.string()});
  }
};

TEST_F(KilledMeasuring, TwiceCostsNothingButTime) {
  const SweepSpec sweep = test::small_sweep();
  kill_first(kMostTries - 1);
  const RunSummary summary = run(sweep, "killed.db", 1);
  EXPECT_TRUE(summary.unflown.empty());
  EXPECT_EQ(summary.progress.done, 8);
}

TEST_F(KilledMeasuring, AgainAndAgainCostsTheTrialsOfThatMap) {
  const SweepSpec sweep = test::small_sweep();
  kill_first(kMostTries);
  const RunSummary summary = run(sweep, "killed.db", 1);
  EXPECT_EQ(summary.progress.done, 4) << "those of the other map";
  ASSERT_EQ(summary.unflown.size(), 4U);
  for (const UnflownTrial& trial : summary.unflown) {
    EXPECT_EQ(trial.reason, "signal 9 (Killed), while it measured the map");
  }
  const RunSummary next = run(sweep, "killed.db", 1);
  EXPECT_TRUE(next.unflown.empty());
  EXPECT_EQ(next.progress.done, 8);
}

TEST_F(KilledMeasuring, BeforeItTakesAJobIsNoOtherEnd) {
  const SweepSpec sweep = test::small_sweep();
  // Its end of the pipe is closed: no job can be sent.
  kill_first(kMostTries - 1, "exec 3<&-");
  const RunSummary summary = run(sweep, "killed.db", 1);
  EXPECT_TRUE(summary.unflown.empty());
  EXPECT_EQ(summary.progress.done, 8);
}

}  // namespace
}  // namespace avoidbench
