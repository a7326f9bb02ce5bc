#include "report/selection.hpp"

#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "report/summary.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_sweep.hpp"

namespace avoidbench {
namespace {

using sample_sweep::result_of;

/// Planner and poisson radius of each trial as fields.
SweepResult with_fields(int map_count, int mission_count) {
  SweepResult result = result_of(map_count, mission_count, [](char planner, int, int mission) {
    return planner == 'a' || mission % 2 == 0;
  });
  result.fields = {"planner", "map.poisson_radius_m"};
  for (TrialSummary& trial : result.trials) {
    double radius_m = 0.0;
    for (int map = 0; map < map_count; ++map) {
      if (result.maps[static_cast<std::size_t>(map)].record.key == trial.map_key) {
        radius_m = 2.5 + 0.5 * map;
      }
    }
    trial.fields = {std::string(), radius_m};
  }
  return result;
}

TableValue whole(std::int64_t value) { return value; }

TEST(Condition, ReadsEverySign) {
  EXPECT_TRUE(holds(parse_condition("x < 3"), 2.5));
  EXPECT_FALSE(holds(parse_condition("x < 3"), 3.0));
  EXPECT_TRUE(holds(parse_condition("x<=3"), whole(3)));
  EXPECT_TRUE(holds(parse_condition("x >2"), whole(3)));
  EXPECT_FALSE(holds(parse_condition("x>= 4"), 3.5));
  EXPECT_TRUE(holds(parse_condition("x = 3"), whole(3)));
  EXPECT_TRUE(holds(parse_condition("x == 3"), 3.0));
  EXPECT_TRUE(holds(parse_condition("planner = ego, mine"), std::string("mine")));
  EXPECT_FALSE(holds(parse_condition("planner = ego, mine"), std::string("min")));
  EXPECT_TRUE(holds(parse_condition("planner != ego, mine"), std::string("reactive")));
  EXPECT_FALSE(holds(parse_condition("planner!=ego,mine"), std::string("ego")));
  EXPECT_TRUE(holds(parse_condition("flag = true"), whole(1)));
  EXPECT_EQ(parse_condition(" map.poisson_radius_m <3 ").field, "map.poisson_radius_m");
}

TEST(Condition, WhatHasNoValueFulfilsOnlyUnequal) {
  EXPECT_FALSE(holds(parse_condition("x < 3"), TableValue{}));
  EXPECT_FALSE(holds(parse_condition("x = 3"), TableValue{}));
  EXPECT_TRUE(holds(parse_condition("x != 3"), TableValue{}));
  EXPECT_FALSE(holds(parse_condition("x < 3"), std::string("2")));  // a text is no number
}

TEST(Condition, ATextEqualsWhatWasWritten) {
  EXPECT_TRUE(holds(parse_condition("planner = 2"), std::string("2")));
  EXPECT_TRUE(holds(parse_condition("planner = ego, true"), std::string("true")));
  EXPECT_TRUE(holds(parse_condition("planner == 1e3"), std::string("1e3")));
  EXPECT_FALSE(holds(parse_condition("planner = 2.0"), std::string("2")));
  EXPECT_FALSE(holds(parse_condition("planner != 2"), std::string("2")));
  EXPECT_TRUE(holds(parse_condition("x = 2.0"), whole(2)));
}

TEST(Condition, RefusesWhatItCantRead) {
  for (const char* text : {"", "x", "x <", "< 3", "x < ego", "x = ", "x = 1,", "x ! 3"}) {
    EXPECT_THROW(parse_condition(text), InputError) << text;
  }
}

TEST(Selection, KeepsTrialsWithTheirMapsAndPlanners) {
  const SweepResult kept =
      selected(with_fields(4, 3), {parse_condition("map.poisson_radius_m <= 3")});
  EXPECT_EQ(kept.maps.size(), 2U);
  EXPECT_EQ(kept.trials.size(), 2U * 3U * 2U);
  EXPECT_EQ(kept.planners.size(), 2U);
}

TEST(Selection, AValueThatNoTrialHasIsAnErrorThatNamesThoseThereAre) {
  SweepResult one = with_fields(2, 2), two = with_fields(2, 2);
  for (TrialSummary& trial : one.trials) trial.fields[0] = std::string("ego");
  for (TrialSummary& trial : two.trials) trial.fields[0] = std::string("mine");
  const std::vector<const SweepResult*> both{&one, &two};
  const auto problem = [&](const std::string& condition) {
    return test::message_of([&] { check_values(both, {parse_condition(condition)}); });
  };
  EXPECT_EQ(problem("planner = ego, mine"), "");  // each in one of the sweeps
  EXPECT_EQ(problem("planner = egoo"),
            "'planner = egoo': no trial has egoo (did you mean ego?); there are: ego, mine");
  EXPECT_EQ(problem("planner != ego, you"),
            "'planner != ego, you': no trial has you; there are: ego, mine");
  EXPECT_EQ(
      problem("map.poisson_radius_m == 2.6"),
      "'map.poisson_radius_m == 2.6': no trial has 2.6 (did you mean 2.5?); there are: 2.5, 3");
  EXPECT_EQ(problem("map.poisson_radius_m < 1"), "");
  for (TrialSummary& trial : two.trials) trial.fields[0] = std::string("2");
  EXPECT_EQ(problem("planner = 2"), "");
  EXPECT_EQ(problem("planner = true"), "'planner = true': no trial has true; there are: 2, ego");
}

TEST(Selection, NothingLeftIsAnError) {
  const ReportQuery query{
      .metrics = {}, .group_by = {}, .where = {parse_condition("map.poisson_radius_m > 9")}};
  EXPECT_THROW(summarize(with_fields(2, 2), query), InputError);
}

TEST(Grouping, ReadsColumns) {
  EXPECT_EQ(parse_group_column("planner").bin_count, 0U);
  const GroupColumn binned = parse_group_column("traversability/5");
  EXPECT_EQ(binned.field, "traversability");
  EXPECT_EQ(binned.bin_count, 5U);
  for (const char* text : {"", "/5", "x/", "x/1", "x/five", "x/5.5", "x/1000"}) {
    EXPECT_THROW(parse_group_column(text), InputError) << text;
  }
}

TEST(Grouping, RowsAreInOrderOfTheColumnsAndMarkTheBestAmongRivals) {
  const ReportQuery query{.metrics = {},
                          .group_by = {{.field = "map.poisson_radius_m"}, {.field = "planner"}},
                          .where = {}};
  const SweepSummary summary = summarize(with_fields(3, 40), query);
  ASSERT_EQ(summary.group_rows.size(), 6U);
  EXPECT_EQ(summary.group_rows[0].keys, (std::vector<TableValue>{2.5, std::string("a")}));
  EXPECT_EQ(summary.group_rows[1].keys, (std::vector<TableValue>{2.5, std::string("b")}));
  EXPECT_EQ(summary.group_rows[5].keys, (std::vector<TableValue>{3.5, std::string("b")}));
  for (std::size_t i = 0; i < 6; ++i) {
    const GroupRow& row = summary.group_rows[i];
    EXPECT_EQ(row.map_count, 1);
    EXPECT_EQ(row.summary.trial_count, 40);
    EXPECT_EQ(row.summary.success_rate, i % 2 == 0 ? 1.0 : 0.5);
    EXPECT_EQ(row.summary.is_best_rate, i % 2 == 0);
  }
}

TEST(Grouping, WithoutPlannerAllAreTakenTogether) {
  const ReportQuery query{
      .metrics = {}, .group_by = {{.field = "map.poisson_radius_m"}}, .where = {}};
  const SweepSummary summary = summarize(with_fields(3, 4), query);
  ASSERT_EQ(summary.group_rows.size(), 3U);
  EXPECT_EQ(summary.group_rows[1].summary.trial_count, 8);
  EXPECT_EQ(summary.group_rows[1].summary.success_rate, 0.75);
}

TEST(Grouping, CutsARangeIntoGroupsOfEqualMapCount) {
  const ReportQuery query{
      .metrics = {}, .group_by = {{.field = "map.poisson_radius_m", .bin_count = 3}}, .where = {}};
  const SweepSummary summary = summarize(with_fields(7, 2), query);
  ASSERT_EQ(summary.group_rows.size(), 3U);
  std::int64_t maps = 0;
  for (const GroupRow& row : summary.group_rows) {
    EXPECT_GE(row.map_count, 2);
    EXPECT_LE(row.map_count, 3);
    maps += row.map_count;
  }
  EXPECT_EQ(maps, 7);
  EXPECT_EQ(summary.group_rows.front().keys.front(), TableValue(std::string("2.500–3.500")));
  const ReportQuery of_text{
      .metrics = {}, .group_by = {{.field = "planner", .bin_count = 3}}, .where = {}};
  EXPECT_THROW(summarize(with_fields(2, 2), of_text), InputError);
}

}  // namespace
}  // namespace avoidbench
