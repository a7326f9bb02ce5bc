#include <gtest/gtest.h>

#include <cmath>

#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "replay/replay.hpp"
#include "support/flown_again.hpp"
#include "support/small_sweep.hpp"
#include "sweep/recorded_latency.hpp"

/// Sweeps whose latencies are measured, and sweeps that fly them again.
namespace avoidbench {
namespace {

class MeasuredLatencyTest : public test::SweepTest {
 protected:
  /// Slowed down so much that latencies of some microseconds matter.
  static SweepSpec measured_sweep() {
    SweepSpec sweep = test::small_sweep();
    sweep.base.latency = {.mode = LatencyMode::measured, .scale = 300.0, .database = {}};
    return sweep;
  }

  SweepSpec replay_of(SweepSpec sweep, const std::string& file) const {
    sweep.base.latency.mode = LatencyMode::replay;
    sweep.base.latency.database = (folder_ / file).string();
    return sweep;
  }

  /// The trials' rows, by map, mission and planner.
  std::map<std::tuple<std::string, std::int64_t, std::string>, TrialRow> rows_of(
      const std::string& file) const {
    const Database database = Database::open_for_reading(folder_ / file);
    std::map<std::tuple<std::string, std::int64_t, std::string>, TrialRow> rows;
    for (const TrialListing& trial : database.list_trials()) {
      TrialRow row = *database.read_trial(trial.key);
      rows[{row.map_key, row.mission_index, row.planner_label}] = row;
    }
    return rows;
  }
};

TEST_F(MeasuredLatencyTest, AReplayFliesTheSameBitsAsTheMeasuredRun) {
  const SweepSpec sweep = measured_sweep();
  EXPECT_EQ(run(sweep, "measured.db", 2).progress.done, 8);
  const SweepSpec again = replay_of(sweep, "measured.db");
  EXPECT_EQ(run(again, "replayed.db", 2).progress.done, 8);
  const std::string rows = rows_;
  run(again, "replayed_alone.db", 1, true);
  EXPECT_EQ(rows_, rows);
  run(replay_of(sweep, "measured.db"), "replayed.db", 1);  // nothing left to do
  EXPECT_EQ(rows_, rows);

  const auto measured = rows_of("measured.db");
  const auto replayed = rows_of("replayed.db");
  ASSERT_EQ(measured.size(), 8U);
  ASSERT_EQ(replayed.size(), 8U);
  double longest_s = 0.0;
  for (const auto& [which, row] : measured) {
    const TrialRow& other = replayed.at(which);
    EXPECT_NE(row.key, other.key);
    const std::vector<std::string> found = differences(row.record, other.record);
    EXPECT_TRUE(found.empty()) << found.front();
    ASSERT_FALSE(row.record.plan_calls.empty());
    for (std::size_t i = 0; i < row.record.plan_calls.size(); ++i) {
      EXPECT_EQ(row.record.plan_calls[i].latency_s, other.record.plan_calls[i].latency_s);
      longest_s = std::max(longest_s, row.record.plan_calls[i].latency_s);
    }
  }
  EXPECT_GT(longest_s, 1.0 / 30);  // calls were missed

  // A replay needs no measured run any more: its own database has the times, too.
  std::filesystem::remove(folder_ / "measured.db");
  const Database database = Database::open_for_reading(folder_ / "replayed.db");
  const test::FlownAgain flown =
      test::flown_again(read_stored_trial(database, database.list_trials().back().key));
  EXPECT_TRUE(flown.flight.warnings.empty()) << flown.flight.warnings.front();
  EXPECT_TRUE(flown.differences().empty());
}

TEST_F(MeasuredLatencyTest, AStoredTrialIsFlownAgainByItsOwnTimes) {
  run(measured_sweep(), "measured.db", 1);
  const Database database = Database::open_for_reading(folder_ / "measured.db");
  for (const TrialListing& trial : database.list_trials()) {
    const test::FlownAgain flown = test::flown_again(read_stored_trial(database, trial.key));
    EXPECT_TRUE(flown.flight.warnings.empty()) << flown.flight.warnings.front();
    const std::vector<std::string> found = flown.differences();
    EXPECT_TRUE(found.empty()) << found.front();
  }
  EXPECT_TRUE(database.read_sweep("small", 1).has_measured_latency);
}

TEST_F(MeasuredLatencyTest, OneOfSeveralModesMarksTheSweep) {
  SweepSpec sweep = test::small_sweep();
  sweep.trials = 1;
  sweep.axes = {{.path = "latency.mode", .values = {"zero", "fixed"}}};
  run(sweep, "modes.db", 2);
  EXPECT_FALSE(
      Database::open_for_reading(folder_ / "modes.db").read_sweep("small", 1).has_measured_latency);
  sweep.axes[0].values.emplace_back("measured");
  EXPECT_EQ(run(sweep, "modes.db", 2).progress.done, 6);
  EXPECT_TRUE(
      Database::open_for_reading(folder_ / "modes.db").read_sweep("small", 2).has_measured_latency);
}

TEST_F(MeasuredLatencyTest, WhatWasNotMeasuredCantBeReplayed) {
  SweepSpec sweep = measured_sweep();
  sweep.trials = 1;
  run(sweep, "measured.db", 2);
  sweep.base.latency.scale = 2.0;
  EXPECT_THROW(expand(replay_of(sweep, "measured.db")), InputError);
  sweep.base.latency.scale = 300.0;
  EXPECT_EQ(expand(replay_of(sweep, "measured.db")).size(), 4U);
  sweep.trials = 2;
  EXPECT_THROW(expand(replay_of(sweep, "measured.db")), InputError);
  EXPECT_THROW(expand(replay_of(sweep, "no.db")), InputError);
}

TEST_F(MeasuredLatencyTest, ACrashHasNoTimesAndItsReplayCrashesToo) {
  SweepSpec sweep = measured_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  PlannerChoice bad;
  bad.label = "segfault";
  bad.file = std::string(BAD_PLANNERS) + "/segfault.so";
  bad.file_digest = PlannerLibrary::load(bad.file).description().file_digest;
  sweep.planners.push_back(bad);
  EXPECT_EQ(run(sweep, "measured.db", 2).progress.done, 3);
  EXPECT_EQ(run(replay_of(sweep, "measured.db"), "replayed.db", 2).progress.done, 3);
  const Database database = Database::open_for_reading(folder_ / "replayed.db");
  int crashed = 0;
  for (const auto& [key, outcome] : database.finished_trials()) {
    crashed += outcome == Outcome::planner_crashed ? 1 : 0;
  }
  EXPECT_EQ(crashed, 1);
}

TEST(LatencyKey, FollowsWhatTheModeUses) {
  TrialSpec spec;
  spec.planner = test::preset_choice("straight_line");
  const std::string fixed = trial_key(spec);
  spec.latency.scale = 2.0;
  spec.latency.database = "elsewhere.db";
  spec.latency_digest = "ab";
  EXPECT_EQ(trial_key(spec), fixed);
  spec.latency.mode = LatencyMode::measured;
  const std::string measured = trial_key(spec);
  EXPECT_NE(measured, fixed);
  spec.latency.ms = 50.0;
  EXPECT_EQ(trial_key(spec), measured);
  spec.latency.scale = 3.0;
  EXPECT_NE(trial_key(spec), measured);
  spec.latency.mode = LatencyMode::replay;
  const std::string replay = trial_key(spec);
  spec.latency.database = "moved.db";
  EXPECT_EQ(trial_key(spec), replay);
  spec.latency_digest = "cd";
  EXPECT_NE(trial_key(spec), replay);
}

}  // namespace
}  // namespace avoidbench
