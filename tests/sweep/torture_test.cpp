#include <gtest/gtest.h>

#include <map>

#include "process/process_tree.hpp"
#include "support/small_sweep.hpp"
#include "worker/crash_report.hpp"

/// What becomes of trials whose worker is killed, stopped or silent, or leaves processes. All other
/// ways to misbehave are those of hostile_runs.py and tests/program_planner/program_runs.py.
namespace avoidbench {
namespace {

PlannerChoice torture_choice(const std::string& way) {
  const PlannerDescription planner = PlannerLibrary::load(TORTURE_FILE).description();
  return PlannerChoice{
      PluginChoice{.plugin = "torture",
                   .label = "torture " + way,
                   .file = TORTURE_FILE,
                   .file_digest = planner.file_digest,
                   .parameters = {{.name = "way", .number = 0.0, .text = way, .is_text = true}}}};
}

class TortureTest : public test::SweepTest {};

TEST_F(TortureTest, SilenceAndWrongAnswersAreToldApart) {
  SweepSpec sweep = test::small_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  options_.silence_s = 3.0;
  options_.trial_timeout_s = 20.0;
  const std::map<std::string, std::pair<Outcome, std::string>> expected{
      {"scribble", {Outcome::planner_crashed, "pipes were closed or written to"}},
      {"empty result", {Outcome::planner_crashed, "closed or written to"}},
      {"keep stopping", {Outcome::planner_hung, "did not answer any more"}},
      {"slow", {Outcome::planner_hung, "longer than its timeout"}}};
  sweep.planners.clear();
  for (const auto& [way, ends] : expected) sweep.planners.push_back(torture_choice(way));
  run(sweep, "ways.db", 2);
  const auto trials = Database::open_for_reading(folder_ / "ways.db").list_trials();
  EXPECT_EQ(trials.size(), expected.size());
  for (const TrialListing& trial : trials) {
    const auto& [outcome, reason] = expected.at(trial.planner_label.substr(8));
    EXPECT_EQ(trial.outcome, outcome) << trial.planner_label << ": " << trial.reason;
    EXPECT_NE(trial.reason.find(reason), std::string::npos)
        << trial.planner_label << ": " << trial.reason;
  }
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
  const CrashStack stack = crash_stack(report, "/elsewhere/mine.so", 3);
  ASSERT_EQ(stack.places.size(), 2U);
  EXPECT_EQ(stack.places[0].text, "mine.so  mine::plan(double)+0x1b");
  EXPECT_EQ(stack.places[0].address, 0U);  // the file is not there
  EXPECT_EQ(stack.places[1].text, "mine.so  +0x1234");
  EXPECT_EQ(stack.places[1].address, 0x1233U);  // of the call, not of where it returns to
}

}  // namespace
}  // namespace avoidbench
