#include "export/trial_list.hpp"

#include <gtest/gtest.h>

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
}

TEST(TrialList, ConditionsChooseByAnyField) {
  std::vector<TrialListing> trials = three();
  for (TrialListing& one : trials) {
    one.fields = {0.5 * static_cast<double>(one.id), one.planner_label};
  }
  const std::vector<std::string> fields{"wind.mean_world_mps.0", "planner"};
  const auto ids = [&](const std::vector<std::string>& where) {
    TrialChoice choice;
    for (const std::string& text : where) choice.where.push_back(parse_condition(text));
    std::vector<std::int64_t> all;
    for (const TrialListing& one : chosen_trials(trials, choice, fields)) all.push_back(one.id);
    return all;
  };
  using Ids = std::vector<std::int64_t>;
  EXPECT_EQ(ids({"wind.mean_world_mps.0 > 0.5"}), (Ids{2, 3}));
  EXPECT_EQ(ids({"wind.mean_world_mps.0 >= 1", "planner = ego"}), (Ids{2}));
  EXPECT_EQ(ids({"planner != ego"}), (Ids{3}));
  // As `report` says it. All conditions are held against all trials.
  EXPECT_EQ(ids({"planner != ego", "planner = ego"}), Ids());
  try {
    ids({"wind.mean_world_mps.0 = 0.6"});
    ADD_FAILURE() << "a value that no trial has";
  } catch (const OptionError& error) {
    EXPECT_EQ(error.option(), "where");
    EXPECT_EQ(
        std::string(error.what()),
        "'wind.mean_world_mps.0 = 0.6': no trial has 0.6 (did you mean 0.5?); there are: 0.5, "
        "1, 1.5");
  }
}

TEST(TrialList, ATrialIsCalledByWhatItsSweepVaries) {
  TrialListing one = listing(1, "ego", Outcome::collided);
  EXPECT_EQ(trial_text(one), "ego, hall seed 7, mission 1");
  one.setting = "poisson_radius_m 3.5, ms 40";
  EXPECT_EQ(trial_text(one), "ego, hall seed 7, poisson_radius_m 3.5, ms 40, mission 1");
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
  EXPECT_EQ(rows[0][6], "start_x_m");
  EXPECT_EQ(rows[3][11], "-3.25");  // goal_z_m
  EXPECT_EQ(rows[3][13], "0.3333333333333333");
  EXPECT_EQ(rows[3][14], "why, it ended");
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
    one.fields = {0.5 * static_cast<double>(one.id), std::string("hall"), one.map_seed};
  }
  // Those that have a column of their own are not shown twice.
  const std::vector<std::string> fields{"wind.gust.amplitude_mps", "generator", "map_seed"};
  const std::string text = format_table(trial_table(trials, fields, true), TableFormat::table);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "id  planner  seed  amplitude_mps  mission  outcome       end_s  reason")
      << text;
  for (TrialListing& one : trials) one.fields.clear();
  const std::string fewer = format_table(trial_table(trials, {}, true), TableFormat::table);
  EXPECT_NE(fewer.find("1,2 → 9,2"), std::string::npos) << fewer;
  const auto rows = parsed_csv(format_table(trial_table(trials, {}, false), TableFormat::csv));
  EXPECT_EQ(rows[0][5], "mission");
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
