#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compare/power_table.hpp"
#include "report/summary.hpp"
#include "report/sweep_tables.hpp"
#include "support/sample_sweep.hpp"

namespace avoidbench {
namespace {

using sample_sweep::result_of;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One trial an element, on one map: its time, negative where it failed.
FlightTimes times_of(const std::vector<double>& times_s) {
  std::vector<TrialSummary> summaries;
  for (const double time_s : times_s) {
    TrialSummary trial;
    trial.outcome = time_s < 0.0 ? Outcome::collided : Outcome::reached_goal;
    trial.end_time_s = std::abs(time_s);
    summaries.push_back(trial);
  }
  Trials trials;
  for (const TrialSummary& trial : summaries) trials.push_back({.trial = &trial, .map = 0});
  return flight_times(0, trials);
}

TEST(FlightTimes, AreQuantilesOfAllTrials) {
  const FlightTimes times = times_of({10.0, 20.0, 30.0, 40.0});
  EXPECT_EQ(times.quartiles_s, (std::array<double, 3>{10.0, 20.0, 30.0}));
  EXPECT_EQ(times.curve.size(), 4U);
  EXPECT_LE(times.median_interval_s.lower, 20.0);
  EXPECT_GE(times.median_interval_s.upper, 20.0);
}

TEST(FlightTimes, AFailureHasNeverArrivedHoweverEarlyItWas) {
  const FlightTimes late = times_of({10.0, 20.0, -50.0, -50.0});
  const FlightTimes early = times_of({10.0, 20.0, -1.0, -2.0});
  EXPECT_EQ(late.quartiles_s, (std::array<double, 3>{10.0, 20.0, kInfinity}));
  EXPECT_EQ(early.quartiles_s, late.quartiles_s);
  EXPECT_EQ(times_of({-1.0, -2.0}).quartiles_s[0], kInfinity);
}

TEST(FlightTimes, TurningAnArrivalIntoAFailureNeverHelps) {
  const std::vector<double> all{12.0, 9.0, 31.0, 14.0, 14.0, 25.0, 18.0};
  const FlightTimes before = times_of(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<double> worse = all;
    worse[i] = -0.5 * worse[i];
    const FlightTimes after = times_of(worse);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_GE(after.quartiles_s[k], before.quartiles_s[k]);
  }
}

TEST(DifficultyResponse, FindsWhereHalfOfTheTrialsSucceed) {
  // Success k of 10 on maps of traversability 0.3 + 0.05 k: half at 0.55, by symmetry.
  const SweepSummary summary = summarize(result_of(
      11, 10, [](char planner, int map, int mission) { return planner == 'b' || mission < map; }));
  ASSERT_EQ(summary.difficulty.size(), 2U);
  const DifficultyResponse& a = summary.difficulty[0];
  EXPECT_NEAR(a.midpoint, 0.55, 1e-6);
  EXPECT_LT(a.midpoint_interval.lower, 0.55);
  EXPECT_GT(a.midpoint_interval.lower, 0.45);
  EXPECT_NEAR(a.midpoint_interval.lower + a.midpoint_interval.upper, 1.1, 1e-6);
  EXPECT_GT(a.slope, 0.0);
  EXPECT_NEAR(a.spearman, 1.0, 1e-12);
  const DifficultyResponse& always = summary.difficulty[1];
  EXPECT_TRUE(always.is_separated);
  EXPECT_TRUE(std::isnan(always.spearman));
}

TEST(DifficultyResponse, FewMapsHaveNone) {
  EXPECT_TRUE(summarize(result_of(4, 10, [](char, int, int mission) {
                return mission < 5;
              })).difficulty.empty());
}

TEST(Environment, CorrelatesMeasuresThatVary) {
  SweepResult result = result_of(6, 2, [](char, int, int) { return true; });
  for (std::size_t i = 0; i < 6; ++i) {
    result.maps[i].record.relative_gap_size = 1.0 + 2.0 * static_cast<double>(i);
  }
  const SweepSummary summary = summarize(result);
  ASSERT_EQ(summary.environment.correlations.size(), 1U);  // the density is the same everywhere
  EXPECT_EQ(summary.environment.correlations[0].measure, "relative_gap_size");
  EXPECT_NEAR(summary.environment.correlations[0].pearson, 1.0, 1e-12);
  EXPECT_EQ(summary.environment.correlations[0].mean, 6.0);
  ASSERT_EQ(summary.environment.maps.size(), 6U);
  EXPECT_EQ(summary.environment.maps[0].trial_count, 4);
}

TEST(Tables, AreThoseThatAreAskedFor) {
  const SweepSummary summary =
      summarize(result_of(6, 4, [](char, int map, int) { return map > 2; }));
  const std::vector<std::string> wanted{"maps", "environment"};
  const Section some = sweep_section(summary, wanted);
  ASSERT_EQ(some.tables.size(), 1U);  // nothing varies but traversability itself
  EXPECT_TRUE(some.tables[0].is_for_people);
  EXPECT_EQ(some.tables[0].rows.size(), 6U);
  for (const Table& table : sweep_section(summary).tables) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
    const std::vector<std::string> names = table_names();
    EXPECT_NE(std::find(names.begin(), names.end(), table.name), names.end()) << table.name;
  }
}

std::vector<std::string> tables_for_people(const Section& section) {
  std::vector<std::string> names;
  for (const Table& table : section.tables) {
    if (table.is_for_people) names.push_back(table.name);
  }
  return names;
}

TEST(Tables, ABriefReportHasGroupsOnlyOfSeveralMaps) {
  const auto some = [](char, int map, int mission) { return map + mission > 3; };
  const SweepSummary few = summarize(result_of(9, 4, some));  // one group has a single map
  const std::vector<std::string> usual{"speed", "planners", "outcomes", "pairs"};
  EXPECT_EQ(tables_for_people(sweep_section(few, {}, Detail::brief)), usual);
  const SweepSummary many = summarize(result_of(10, 4, some));
  const std::vector<std::string> with_groups{"speed", "planners", "groups", "outcomes", "pairs"};
  EXPECT_EQ(tables_for_people(sweep_section(many, {}, Detail::brief)), with_groups);
  const std::vector<std::string> all{"speed", "planners",   "groups",     "outcomes",
                                     "pairs", "difficulty", "flight_time"};
  EXPECT_EQ(tables_for_people(sweep_section(few)), all);
  // Machines get all of it; what is asked for by name has its legend.
  EXPECT_EQ(sweep_section(few, {}, Detail::brief).tables.size(), sweep_section(few).tables.size());
  const std::vector<std::string> wanted{"pairs"};
  EXPECT_FALSE(sweep_section(few, wanted, Detail::brief).is_brief);
}

TEST(Tables, SweepsStandSideBySide) {
  SweepSummary one = summarize(result_of(3, 4, [](char, int, int) { return true; }));
  SweepSummary two = summarize(result_of(3, 4, [](char, int, int) { return false; }));
  two.name = "hall";
  const std::vector<SweepSummary> both{one, two};
  const Table table = side_by_side(both).tables.front();
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(std::get<std::string>(table.rows[0][0].value), "a");
  EXPECT_EQ(std::get<std::string>(table.rows[0][1].value), "forest");
  EXPECT_EQ(std::get<std::string>(table.rows[1][1].value), "hall");
}

std::int64_t count_in(const Section& section, const std::string& test) {
  for (const auto& row : section.tables.front().rows) {
    if (std::get<std::string>(row[0].value).find(test) != std::string::npos) {
      return std::get<std::int64_t>(row[1].value);
    }
  }
  return -1;
}

TEST(Power, GivesPublishedFigures) {
  PowerQuestion question{.success_rate = 0.9, .detect = 0.1, .discordance = {}, .trials = {}};
  EXPECT_EQ(count_in(power_section(question), "normal"), 199);
  question.success_rate = 0.6;
  EXPECT_EQ(count_in(power_section(question), "normal"), 388);  // 387.3, published as 387
  EXPECT_GT(count_in(power_section(question), "Fisher"), 387);
}

TEST(Power, RefusesWhatIsNoQuestion) {
  EXPECT_THROW(power_section({.success_rate = 1.2, .discordance = {}, .trials = {}}),
               std::exception);
  EXPECT_THROW(power_section({.detect = 0.95, .discordance = {}, .trials = {}}), std::exception);
  EXPECT_THROW(power_section({.power = 1.0, .discordance = {}, .trials = {}}), std::exception);
  EXPECT_THROW(power_section({.discordance = 0.01, .trials = {}}), std::exception);
}

}  // namespace
}  // namespace avoidbench
