#include "export/trial_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/option_error.hpp"
#include "export/export_flight.hpp"
#include "report/parsed_csv.hpp"

namespace avoidbench {
namespace {

TrialListing listing(std::int64_t id, const std::string& planner, Outcome outcome) {
  TrialListing one;
  one.id = id;
  one.key = "abcd" + std::to_string(id) + std::string(59, '0');
  one.planner_label = planner;
  one.generator = "hall";
  one.map_seed = 7;
  one.poisson_radius_m = 2.5;
  one.mission_index = id % 2;
  one.outcome = outcome;
  one.end_time_s = 1.0 / 3.0;
  one.reason = "why, it ended";
  one.mission = {.start_world = {1.0, 2.0, 0.5}, .goal_world = {9.0, 2.0, -3.25}};
  return one;
}

std::vector<TrialListing> three() {
  return {listing(1, "ego", Outcome::reached_goal), listing(2, "ego", Outcome::collided),
          listing(3, "a_planner_with_a_long_label", Outcome::collided)};
}

std::string error_of(const TrialChoice& choice) {
  try {
    static_cast<void>(the_trial(three(), choice));
  } catch (const OptionError& error) {
    return error.option() + "|" + error.what() + "|" + error.hint();
  }
  return "";
}

TEST(TrialList, ATrialIsNamedByIdKeyOrWhatItWas) {
  EXPECT_EQ(the_trial(three(), {.trial = "2"}).id, 2);
  EXPECT_EQ(the_trial(three(), {.trial = "abcd3"}).id, 3);
  EXPECT_EQ(the_trial(three(), {.planner = "ego", .outcome = "collided"}).id, 2);
  EXPECT_EQ(chosen_trials(three(), {.outcome = "collided"}).size(), 2U);
  EXPECT_EQ(chosen_trials(three(), {.map_seed = 8}).size(), 0U);
  EXPECT_EQ(chosen_trials(three(), {.radius_m = 2.5}).size(), 3U);
}

TEST(TrialList, WhatIsNotThereIsToldWithWhatIs) {
  EXPECT_EQ(error_of({.trial = "9"}), "|no trial 9; the nearest ids are 3, 2, 1|list");
  EXPECT_EQ(error_of({.planner = "eggo"}),
            "planner|eggo: no trial has it (did you mean ego?); there are: "
            "a_planner_with_a_long_label, ego|");
  EXPECT_EQ(error_of({.outcome = "collided"}), "|2 trials match (ids 2, 3): name one|list");
}

TEST(TrialList, TableIsShortForPeopleAndWholeForPrograms) {
  const std::string text = format_table(trial_table(three(), {}, true), TableFormat::table);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "id  planner           seed  mission  outcome       end_s  reason");
  EXPECT_NE(text.find("\n 3  a_planner_with_…     7        1  collided       0.33  "
                      "why, it ended\n"),
            std::string::npos)
      << text;
  const auto rows = parsed_csv(format_table(trial_table(three(), {}, false), TableFormat::csv));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0][1], "trial_key");
  EXPECT_EQ(rows[3][2], "a_planner_with_a_long_label");
  EXPECT_EQ(rows[0][7], "start_x_m");
  EXPECT_EQ(rows[3][12], "-3.25");  // goal_z_m
  EXPECT_EQ(rows[3][14], "0.3333333333333333");
  EXPECT_EQ(rows[3][15], "why, it ended");
  const nlohmann::json json =
      nlohmann::json::parse(format_table(trial_table(three(), {}, false), TableFormat::json));
  EXPECT_EQ(json.at(2).at("seed"), 7);
  EXPECT_EQ(json.at(2).at("end_s"), 1.0 / 3.0);
}

TEST(TrialList, LabelsThatDifferNeverLookTheSame) {
  std::vector<TrialListing> trials = three();
  trials[0].planner_label = "a_planner_with_a_long_label";
  trials[1].planner_label = "a_planner_with_a_long_lamp";
  trials[2].planner_label = "a_planner_with_another_label";
  const Table table = trial_table(trials, {}, true);
  const auto label = [&](std::size_t row) {
    return std::get<std::string>(table.rows[row][1].value);
  };
  EXPECT_EQ(label(0), "a_plann…ng_label");
  EXPECT_EQ(label(1), "a_plann…ong_lamp");
  EXPECT_EQ(label(2), "a_plann…er_label");
}

TEST(TrialList, ShowsAxesAndWhereThereIsRoomStartAndGoal) {
  std::vector<TrialListing> trials = three();
  trials[2].planner_label = "ego";
  for (TrialListing& one : trials) {
    one.poisson_radius_m = std::nan("");  // a map from a file
    one.fields = {0.5 * static_cast<double>(one.id)};
  }
  const std::vector<std::string> fields{"wind.gust.amplitude_mps"};
  const std::string text = format_table(trial_table(trials, fields, true), TableFormat::table);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "id  planner  seed  amplitude_mps  mission  outcome       end_s  reason")
      << text;
  for (TrialListing& one : trials) one.fields.clear();
  const std::string fewer = format_table(trial_table(trials, {}, true), TableFormat::table);
  EXPECT_NE(fewer.find("1,2 → 9,2"), std::string::npos) << fewer;
  const auto rows = parsed_csv(format_table(trial_table(trials, {}, false), TableFormat::csv));
  EXPECT_EQ(rows[0][5], "mission");  // no radius
}

TEST(TrialOrder, TheWorstComeFirstAndThoseWithoutValueLast) {
  using Values = std::vector<TableValue>;
  using Places = std::vector<std::size_t>;
  const Values values{2.0, std::monostate(), 0.5, std::int64_t{3}};
  EXPECT_EQ(worst_first(values, Better::more), (Places{2, 0, 3, 1}));
  EXPECT_EQ(worst_first(values, Better::less), (Places{3, 0, 2, 1}));
  EXPECT_EQ(worst_first(values, Better::neither), (Places{3, 0, 2, 1}));
  EXPECT_EQ(better_of("planner", {}), Better::more);
  std::vector<TrialListing> trials = three();
  for (TrialListing& one : trials) one.fields = {static_cast<double>(one.id % 3)};
  const TrialOrder order{.field = "x", .limit = 2};
  const auto sorted = in_order(trials, order, {"x"}, {});
  ASSERT_EQ(sorted.size(), 2U);
  EXPECT_EQ(sorted[0].id, 3);
  EXPECT_EQ(sorted[1].id, 1);
}

TEST(ExportCommands, ATrajectoryShowsItsFirstAndLastPoint) {
  CommandLine call;
  call.time_s = 0.1;
  call.status = PlanStatus::command;
  call.command.kind = AB_COMMAND_TRAJECTORY;
  call.command.horizon_s = 2.0;
  call.points.resize(2);
  call.points[0].position_world_m[0] = 1.0;
  call.points[1].position_world_m[0] = 4.0;
  call.points[1].time_s = 1.5;
  CommandLine none = call;
  none.status = PlanStatus::no_plan;
  none.points.clear();
  const auto rows = parsed_csv(commands_csv({call, none}));
  ASSERT_EQ(rows.size(), 3U);
  const auto field = [&](std::size_t row, const std::string& name) {
    for (std::size_t i = 0; i < rows[0].size(); ++i) {
      if (rows[0][i] == name) return rows[row][i];
    }
    return "no column " + name;
  };
  EXPECT_EQ(field(1, "kind"), "trajectory");
  EXPECT_EQ(field(1, "x_m"), "1");
  EXPECT_EQ(field(1, "end_x_m"), "4");
  EXPECT_EQ(field(1, "duration_s"), "1.5");
  EXPECT_EQ(field(2, "status"), "no_plan");
  EXPECT_EQ(field(2, "x_m"), "");
  EXPECT_EQ(field(2, "horizon_s"), "");
}

}  // namespace
}  // namespace avoidbench
