#include "sweep/standing_flights.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace avoidbench {
namespace {

std::vector<MetricRow> metrics(const std::vector<std::string>& names) {
  std::vector<MetricRow> rows;
  for (const std::string& name : names) rows.emplace_back().name = name;
  return rows;
}

TEST(StandingFlights, CountsTrialsInWhichAPlannerNeverFlew) {
  StandingFlights flights(
      metrics({"path_length_m", "mean_speed_mps", "plan_call_count", "no_plan_count"}));
  flights.add("blind", Outcome::timed_out,
              std::vector{0.6, 0.01, 1800.0, 0.0});  // commands to stand
  flights.add("blind", Outcome::timed_out, std::vector{0.6, 0.01, 1800.0, 1800.0});
  flights.add("blind", Outcome::timed_out, std::vector{60.0, 1.0, 1800.0, 1799.0});
  flights.add("fine", Outcome::reached_goal,
              std::vector{0.1, 0.05, 3.0, 0.0});  // began at the goal
  flights.add("fine", Outcome::collided, std::vector{0.1, 0.05, 3.0, 0.0});
  flights.add("fine", Outcome::planner_error,
              std::vector{0.0, std::nan(""), 0.0, 0.0});  // never called
  const auto& counts = flights.by_planner();
  EXPECT_EQ(counts.at("blind").trials, 3);
  EXPECT_EQ(counts.at("blind").standing, 2);
  EXPECT_EQ(counts.at("blind").silent, 1);
  EXPECT_EQ(counts.at("fine").standing, 0);
  EXPECT_EQ(counts.at("fine").silent, 0);
  const std::vector<std::string> warnings = standing_warnings("blind", counts.at("blind"));
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(
      warnings[0].starts_with("blind stood still until the time was up in 2 of 3 trials "
                              "(mean speed below 0.1 m/s)"))
      << warnings[0];
  EXPECT_EQ(warnings[1], "blind gave no command at all in 1 of 3 trials");
  EXPECT_TRUE(standing_warnings("fine", counts.at("fine")).empty());
}

TEST(StandingFlights, CountsNothingInADatabaseWithoutTheMetrics) {
  StandingFlights flights(metrics({"mean_speed_mps", "no_plan_count"}));
  flights.add("blind", Outcome::timed_out, std::vector{0.01, 1800.0});
  EXPECT_TRUE(flights.by_planner().empty());
}

}  // namespace
}  // namespace avoidbench
