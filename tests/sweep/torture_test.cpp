#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "process/process_tree.hpp"
#include "process/sandbox.hpp"
#include "support/small_sweep.hpp"
#include "worker/crash_report.hpp"

/// Planners that misbehave in every way there is: each costs its own trial, and nothing else.
namespace avoidbench {
namespace {

PlannerChoice torture_choice(const std::string& way) {
  const PlannerDescription planner = PlannerLibrary::load(TORTURE_FILE).description();
  return {.plugin = "torture",
          .label = "torture " + way,
          .file = TORTURE_FILE,
          .file_digest = planner.file_digest,
          .parameters = {{.name = "way", .number = 0.0, .text = way, .is_text = true}}};
}

/// The rows of what is not of the torture planner: by what a row begins with and its keys.
std::string good_rows(const Database& database) {
  std::map<std::string, std::string> planners;
  std::string rows;
  for (const TrialListing& trial : database.list_trials()) {
    if (trial.planner_label.starts_with("torture")) planners[trial.key] = trial.planner_label;
  }
  std::istringstream lines(test::canonical_rows(database));
  for (std::string line; std::getline(lines, line);) {
    bool is_bad = line.starts_with("sweep\t") || line.find("torture") != std::string::npos;
    for (const auto& [key, label] : planners) {
      is_bad = is_bad || line.find(key) != std::string::npos;
    }
    if (!is_bad) rows += line + '\n';
  }
  return rows;
}

class TortureTest : public test::SweepTest {};

TEST_F(TortureTest, EveryWayBecomesTheOutcomeOfItsTrial) {
  SweepSpec sweep = test::small_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  options_.silence_s = 3.0;
  options_.trial_timeout_s = 20.0;
  const std::map<std::string, std::pair<Outcome, std::string>> expected{
      {"segfault", {Outcome::planner_crashed, "signal 11 (Segmentation fault) in "}},
      {"abort", {Outcome::planner_crashed, "signal 6 (Aborted) in "}},
      {"exit", {Outcome::planner_crashed, "exit code 0"}},
      {"throw", {Outcome::planner_error, "thrown by the planner"}},
      {"loop", {Outcome::planner_hung, "longer than the plan timeout"}},
      {"overflow", {Outcome::planner_crashed, "signal 11 (Segmentation fault) in "}},
      {"close", {Outcome::planner_crashed, "pipes were closed"}},
      {"reopen", {Outcome::planner_crashed, "pipes were closed"}},
      {"scribble", {Outcome::planner_crashed, "pipes were closed or written to"}},
      {"nan", {Outcome::planner_error, ""}},
      {"terminate", {Outcome::planner_crashed, "signal 6 (Aborted) in "}},
      {"keep stopping", {Outcome::planner_hung, "did not answer any more"}},
      {"half a header", {Outcome::planner_crashed, "closed or written to"}},
      {"huge header", {Outcome::planner_crashed, "closed or written to"}},
      {"empty result", {Outcome::planner_crashed, "closed or written to"}},
      {"slow", {Outcome::planner_hung, "longer than its timeout"}}};
  sweep.planners.clear();
  for (const auto& [way, ends] : expected) sweep.planners.push_back(torture_choice(way));
  EXPECT_EQ(run(sweep, "ways.db", 2).progress.done, static_cast<std::int64_t>(expected.size()));
  const Database database = Database::open_for_reading(folder_ / "ways.db");
  for (const TrialListing& trial : database.list_trials()) {
    const auto& [outcome, reason] = expected.at(trial.planner_label.substr(8));
    EXPECT_EQ(trial.outcome, outcome) << trial.planner_label << ": " << trial.reason;
    EXPECT_NE(trial.reason.find(reason), std::string::npos)
        << trial.planner_label << ": " << trial.reason;
  }
}

TEST_F(TortureTest, OtherPlannersFlyAsWithoutIt) {
  SweepSpec sweep = test::small_sweep();
  sweep.trials = 8;
  run(sweep, "without.db", 2);
  const std::string without = good_rows(Database::open_for_reading(folder_ / "without.db"));
  sweep.planners.insert(sweep.planners.begin() + 1, torture_choice("seeded"));
  const RunSummary with = run(sweep, "with.db", 2);
  EXPECT_EQ(with.progress.done + with.progress.invalid_missions, with.progress.total);
  EXPECT_EQ(good_rows(Database::open_for_reading(folder_ / "with.db")), without);
}

TEST_F(TortureTest, MemoryBeyondTheLimitIsACrash) {
  SweepSpec sweep = test::small_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  sweep.planners = {torture_choice("memory")};
  options_.worker_command[3] = "60";
  run(sweep, "memory.db", 1);
  const auto trials = Database::open_for_reading(folder_ / "memory.db").list_trials();
  ASSERT_EQ(trials.size(), 1U);
  EXPECT_EQ(trials[0].outcome, Outcome::planner_crashed);
  EXPECT_NE(trials[0].reason.find("more memory than its limit"), std::string::npos)
      << trials[0].reason;
}

/// As by a kernel that is short of memory, or by a person: no planner's fault.
TEST_F(TortureTest, ATrialWhoseWorkerIsKilledIsFlownAgainOnce) {
  SweepSpec sweep = test::small_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  sweep.planners = {torture_choice("kill once, " + (folder_ / "killed").string())};
  run(sweep, "once.db", 1);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "killed"));
  const auto trials = Database::open_for_reading(folder_ / "once.db").list_trials();
  ASSERT_EQ(trials.size(), 1U);
  EXPECT_NE(trials[0].outcome, Outcome::planner_crashed) << trials[0].reason;
}

/// Nobody knows who did it: the trial is not stored, and flown by the next run.
TEST_F(TortureTest, ATrialWhoseWorkerIsKilledAgainStaysUnflown) {
  SweepSpec sweep = test::small_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  sweep.planners.push_back(torture_choice("kill"));
  const RunSummary summary = run(sweep, "twice.db", 2);
  ASSERT_EQ(summary.unflown.size(), 1U);
  EXPECT_EQ(summary.unflown[0].planner_label, "torture kill");
  EXPECT_NE(summary.unflown[0].reason.find("signal 9"), std::string::npos);
  EXPECT_EQ(summary.progress.done, 2);
  EXPECT_EQ(Database::open_for_reading(folder_ / "twice.db").list_trials().size(), 2U);
  sweep.planners.back() = torture_choice("nothing");
  EXPECT_EQ(run(sweep, "twice.db", 2).unflown.size(), 0U);
}

TEST_F(TortureTest, AWorkerStoppedOnceGoesOn) {
  SweepSpec sweep = test::small_sweep();
  sweep.trials = 1;
  options_.silence_s = 1.5;
  sweep.planners = {torture_choice("nothing")};
  run(sweep, "nothing.db", 1);
  const auto flown = Database::open_for_reading(folder_ / "nothing.db").list_trials();
  sweep.planners = {torture_choice("stop")};
  run(sweep, "stop.db", 1);
  const auto stopped = Database::open_for_reading(folder_ / "stop.db").list_trials();
  ASSERT_EQ(stopped.size(), flown.size());
  for (std::size_t i = 0; i < flown.size(); ++i) {
    EXPECT_EQ(stopped[i].outcome, flown[i].outcome);
    EXPECT_EQ(stopped[i].end_time_s, flown[i].end_time_s);
  }
}

/// The child of a fork goes on as if it were the worker, and a daemon stays: neither changes what
/// is stored, and neither is there when the run is over.
TEST_F(TortureTest, ForkedProcessesHaveNoSayAndDoNotStay) {
  SweepSpec sweep = test::small_sweep();
  sweep.trials = 2;
  std::map<std::string, std::string> flights;
  for (const std::string way : {"nothing", "fork and return", "leave a daemon"}) {
    sweep.planners = {torture_choice(way)};
    const RunSummary summary = run(sweep, way.substr(0, 4) + ".db", 1);
    EXPECT_EQ(summary.left_behind.contains("torture leave a daemon"), way == "leave a daemon");
    const Database database = Database::open_for_reading(folder_ / (way.substr(0, 4) + ".db"));
    for (const TrialListing& trial : database.list_trials()) {
      flights[way] += std::to_string(trial.mission_index) + " " + std::to_string(trial.end_time_s) +
                      trial.reason + "\n";
    }
    EXPECT_FALSE(has_children());
  }
  EXPECT_EQ(flights["fork and return"], flights["nothing"]);
  EXPECT_EQ(flights["leave a daemon"], flights["nothing"]);
}

/// In the sandbox what it tries fails, and it flies on.
TEST_F(TortureTest, TheSandboxRefusesWhatHarmsOthers) {
  options_.sandbox = text(sandbox_support());
  if (options_.sandbox.empty()) GTEST_SKIP() << "this kernel has none";
  SweepSpec sweep = test::small_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  sweep.planners = {test::preset_choice("straight_line")};
  const std::string file = (folder_ / "killed").string();
  for (const std::string& way : {std::string("kill"), std::string("stop"),
                                 std::string("leave a daemon"), "kill once, " + file}) {
    sweep.planners.push_back(torture_choice(way));
  }
  const RunSummary summary = run(sweep, "sandbox.db", 2);
  EXPECT_TRUE(summary.unflown.empty());
  EXPECT_TRUE(summary.left_behind.empty());
  EXPECT_FALSE(std::filesystem::exists(file));
  const auto trials = Database::open_for_reading(folder_ / "sandbox.db").list_trials();
  ASSERT_EQ(trials.size(), 5U);
  for (const TrialListing& trial : trials) {
    EXPECT_NE(trial.outcome, Outcome::planner_crashed) << trial.planner_label << trial.reason;
    EXPECT_NE(trial.outcome, Outcome::planner_hung) << trial.planner_label << trial.reason;
  }
}

TEST_F(TortureTest, RoundingAndOutputOfAPlannerChangeNothing) {
  SweepSpec sweep = test::small_sweep();
  sweep.trials = 1;
  std::map<std::string, std::string> flights;
  for (const std::string way : {"nothing", "round", "print"}) {
    sweep.planners = {torture_choice(way)};
    run(sweep, way + ".db", 1);
    const Database database = Database::open_for_reading(folder_ / (way + ".db"));
    for (const TrialListing& trial : database.list_trials()) {
      flights[way] += std::to_string(trial.end_time_s) + trial.reason;
    }
  }
  EXPECT_EQ(flights["round"], flights["nothing"]);
  EXPECT_EQ(flights["print"], flights["nothing"]);
}

TEST(CrashReport, NamesThePlacesInThePlannersLibrary) {
  const std::string report =
      "/usr/bin/avoidbench(_ZN10avoidbench5writeEi+0x20) [0x55d]\n"
      "/lib/libc.so.6(+0x3c050) [0x7f1]\n"
      "/home/me/mine.so(_ZN4mine4planEd+0x1b) [0x7f2]\n"
      "/home/me/mine.so(_ZN4mine4planEd+0x1b) [0x7f2]\n"
      "/home/me/mine.so(+0x1234) [0x7f3]\n";
  EXPECT_EQ(crash_places(report, "/elsewhere/mine.so"), "mine::plan(double)+0x1b < +0x1234");
  EXPECT_EQ(crash_places(report, "/elsewhere/other.so"), "");
  EXPECT_EQ(crash_places("no stack at all", "mine.so"), "");
  EXPECT_EQ(crash_site(report, "/elsewhere/mine.so"), "mine.so: mine::plan(double)+0x1b < +0x1234");
  EXPECT_EQ(crash_site(report, "/elsewhere/other.so"), "mine.so: mine::plan(double)");
  EXPECT_EQ(crash_site("/usr/bin/avoidbench(main+0x1) [0x1]\n/lib/libc.so.6(abort+0x1) "
                       "[0x1]\n/x/libgrid.so.2(_ZN4Grid2atEi+0x9) [0x2]\n",
                       "/elsewhere/mine.so"),
            "libgrid.so.2: Grid::at(int)");
  EXPECT_EQ(crash_site("no stack at all", "mine.so"), "");
  // The SDK's frames around a planner's function, which is inlined into the first of them.
  const std::string sdk =
      "/usr/bin/avoidbench(main+0x1) [0x1]\n"
      "/x/mine.so(_ZZN10avoidbench6detail4planI5TalksEEiPvPK14ab_observationP10ab_commandENKUlvE_"
      "clEv+0x33) [0x2]\n"
      "/x/mine.so(_ZN10avoidbench6detail4planI5TalksEEiPvPK14ab_observationP10ab_command+0x31) "
      "[0x3]\n";
  EXPECT_EQ(crash_site(sdk, "mine.so"), "mine.so: Talks::plan+0x33");
  const std::vector<std::string> lines = stack_lines(report, "/elsewhere/mine.so", 3);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "mine.so  mine::plan(double)+0x1b");
  EXPECT_EQ(lines[1], "mine.so  +0x1234");
}

}  // namespace
}  // namespace avoidbench
