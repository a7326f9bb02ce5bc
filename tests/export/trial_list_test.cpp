#include "export/trial_list.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/option_error.hpp"
#include "export/export_commands.hpp"
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
  const std::string text = format_table(trial_table(three(), true), TableFormat::table);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "id  planner           map   seed  radius_m  mission  outcome       end_s  reason");
  EXPECT_NE(text.find("\n 3  a_planner_with_…  hall     7      2.50        1  collided       0.33  "
                      "why, it ended\n"),
            std::string::npos)
      << text;
  const auto rows = parsed_csv(format_table(trial_table(three(), false), TableFormat::csv));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0][1], "trial_key");
  EXPECT_EQ(rows[3][2], "a_planner_with_a_long_label");
  EXPECT_EQ(rows[3][8], "0.3333333333333333");
  EXPECT_EQ(rows[3][9], "why, it ended");
  const nlohmann::json json =
      nlohmann::json::parse(format_table(trial_table(three(), false), TableFormat::json));
  EXPECT_EQ(json.at(2).at("seed"), 7);
  EXPECT_EQ(json.at(2).at("end_s"), 1.0 / 3.0);
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
