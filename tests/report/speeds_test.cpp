#include "report/speeds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "report/speed_tables.hpp"
#include "report/sweep_tables.hpp"
#include "support/sample_sweep.hpp"

namespace avoidbench {
namespace {

using sample_sweep::has_warning;
using sample_sweep::result_of;

/// Planner `a` flies 40 missions at 1 to 4 m/s, `b` all at 1 m/s; `fails` says which a fails.
SweepResult two_planners(bool (*fails)(int map, int mission)) {
  SweepResult result = result_of(10, 4, [&](char planner, int map, int mission) {
    return planner == 'b' || !fails(map, mission);
  });
  for (TrialSummary& trial : result.trials) {
    const bool is_a = trial.planner_key == planner_key(result.planners[0]);
    const double speed_mps = is_a ? 1.0 + static_cast<double>(trial.mission_index) : 1.0;
    trial.end_time_s = trial.reference_length_m / speed_mps;
  }
  return result;
}

TEST(Speeds, V90IsTheSpeedOfTheFlightThatNineOfTenBeat) {
  const SweepSummary all = summarize(two_planners([](int, int mission) { return mission < 0; }));
  ASSERT_EQ(all.speeds.size(), 2U);
  EXPECT_EQ(all.speeds[0].v90.value, 1.0);  // a quarter of the missions is at 1 m/s
  EXPECT_EQ(all.speeds[0].v50.value, 3.0);
  EXPECT_EQ(all.speeds[0].mean.value, 2.5);
  EXPECT_EQ(all.speeds[1].v90.value, 1.0);
  EXPECT_EQ(all.speeds[0].crash_count, 0);
  EXPECT_TRUE(std::isnan(all.speeds[0].crashes_per_km.value));  // the sample has no path lengths
  ASSERT_EQ(all.contrasts.size(), 1U);
  EXPECT_EQ(all.contrasts[0].v90.difference_mps, 0.0);
  EXPECT_EQ(all.contrasts[0].v90.p, 1.0);
  // Without its slow missions' share of failures: 4 of 40 fail, 10 %.
  const SweepSummary tenth =
      summarize(two_planners([](int map, int mission) { return mission == 0 && map < 4; }));
  EXPECT_EQ(tenth.speeds[0].v90.value, 1.0);
  EXPECT_EQ(tenth.speeds[0].crash_count, 4);
  EXPECT_FALSE(has_warning(tenth, "v90 is 0"));
}

TEST(Speeds, ElevenPercentOfFailuresGiveZeroAndTheReportSaysSo) {
  const SweepSummary summary =
      summarize(two_planners([](int map, int mission) { return mission == 0 && map < 5; }));
  EXPECT_EQ(summary.speeds[0].v90.value, 0.0);
  EXPECT_EQ(summary.speeds[0].v50.value, 3.0);
  EXPECT_TRUE(has_warning(summary, "v90 is 0 for a (87.5 %)"));
}

TEST(Speeds, FewerThanTwentyNineMissionsHaveNone) {
  const SweepSummary summary = summarize(result_of(7, 4, [](char, int, int) { return true; }));
  EXPECT_TRUE(std::isnan(summary.speeds[0].v90.value));
  EXPECT_FALSE(std::isnan(summary.speeds[0].v50.value));
  EXPECT_TRUE(std::isnan(summary.contrasts[0].v90.p));
  EXPECT_TRUE(has_warning(summary, "no v90 of a, b: it needs at least 29 missions"));
}

TEST(Speeds, TheBestOfSettingsIsNamedAsSuch) {
  SweepResult result = two_planners([](int, int) { return false; });
  for (PlannerRow& planner : result.planners) {
    const std::string before = planner_key(planner);
    planner.name = "one";
    planner.file_digest = "of one file";
    for (TrialSummary& trial : result.trials) {
      if (trial.planner_key == before) trial.planner_key = planner_key(planner);
    }
  }
  const SweepSummary summary = summarize(result);
  ASSERT_EQ(summary.best_settings.size(), 1U);
  EXPECT_EQ(summary.best_settings[0].setting_count, 2U);
  EXPECT_EQ(speed_table(summary).rows.size(), 2U);
  EXPECT_TRUE(has_warning(summary, "a is the best of 2 settings"));
}

TEST(Speeds, WhatSeesTheWorldDoesNotCompete) {
  SweepResult result = result_of(12, 5, [](char, int, int) { return true; }, {"a", "b", "c"});
  for (TrialSummary& trial : result.trials) {
    const bool is_fast = trial.planner_key == planner_key(result.planners[0]);
    const bool is_mean = trial.planner_key == planner_key(result.planners[1]);
    trial.end_time_s = trial.reference_length_m / (is_fast ? 3.0 : is_mean ? 2.0 : 1.0);
  }
  EXPECT_TRUE(summarize(result).speeds[0].is_best);
  const std::string before = planner_key(result.planners[0]);
  result.planners[0].is_privileged = true;
  for (TrialSummary& trial : result.trials) {
    if (trial.planner_key == before) trial.planner_key = planner_key(result.planners[0]);
  }
  const SweepSummary summary = summarize(result);
  EXPECT_FALSE(summary.speeds[0].is_best);
  EXPECT_TRUE(summary.speeds[1].is_best);
}

TEST(Speeds, TheCurveFallsFromOneToTheFastest) {
  const Table table = speed_curve_table(summarize(two_planners([](int, int) { return false; })));
  ASSERT_EQ(table.rows.size(), 5U + 2U);  // 0, 1, 2, 3, 4 m/s; 0, 1
  EXPECT_EQ(std::get<double>(table.rows[0][2].value), 1.0);
  EXPECT_EQ(std::get<double>(table.rows[4][1].value), 4.0);
  EXPECT_EQ(std::get<double>(table.rows[4][2].value), 0.25);
}

}  // namespace
}  // namespace avoidbench
