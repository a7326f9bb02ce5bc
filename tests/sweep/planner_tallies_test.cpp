#include "sweep/planner_tallies.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace avoidbench {
namespace {

std::vector<MetricRow> metrics(const std::vector<std::string>& names) {
  std::vector<MetricRow> rows;
  for (const std::string& name : names) rows.emplace_back().name = name;
  return rows;
}

// In an order of their own, beside another.
const std::vector<std::string> kTimes{"processing_time_ms", "finished", "plan_call_count",
                                      "processing_wall_time_ms", "deadline_miss_count"};

TEST(PlannerTallies, TimesAreMeansOverAllCallsOfAPlanner) {
  PlannerTallies tallies(metrics(kTimes));
  const auto add = [&](const char* planner, const std::vector<double>& values) {
    tallies.add(planner, Outcome::reached_goal, values);
  };
  add("a", {10.0, 1.0, 100.0, 14.0, 5.0});
  add("b", {3.0, 1.0, 7.0, 4.0, 1.0});
  add("a", {40.0, 0.0, 300.0, 50.0, 20.0});
  add("a", {std::nan(""), 0.0, 0.0, std::nan(""), 0.0});  // no call
  add("c", {std::nan(""), 0.0, 8.0, std::nan(""), std::nan("")});
  const auto& found = tallies.by_planner();
  EXPECT_EQ(found.at("c").calls, 0.0) << "nobody measured times";
  const CallTimes a = found.at("a").call_times();
  EXPECT_EQ(a.count, 400);
  EXPECT_EQ(a.late_count, 25);
  EXPECT_NEAR(a.cpu_s, 1e-3 * (100.0 * 10.0 + 300.0 * 40.0) / 400.0, 1e-12);
  EXPECT_NEAR(a.wall_s, 1e-3 * (100.0 * 14.0 + 300.0 * 50.0) / 400.0, 1e-12);
  EXPECT_EQ(found.at("b").call_times().count, 7);
  EXPECT_NEAR(found.at("b").call_times().wall_s, 4e-3, 1e-12);
}

TEST(PlannerTallies, CountsTrialsInWhichAPlannerNeverFlew) {
  PlannerTallies tallies(
      metrics({"path_length_m", "mean_speed_mps", "plan_call_count", "no_plan_count"}));
  tallies.add("blind", Outcome::timed_out,
              std::vector{0.6, 0.01, 1800.0, 0.0});  // commands to stand
  tallies.add("blind", Outcome::timed_out, std::vector{0.6, 0.01, 1800.0, 1800.0});
  tallies.add("blind", Outcome::timed_out, std::vector{60.0, 1.0, 1800.0, 1799.0});
  tallies.add("fine", Outcome::reached_goal,
              std::vector{0.1, 0.05, 3.0, 0.0});  // began at the goal
  tallies.add("fine", Outcome::collided, std::vector{0.1, 0.05, 3.0, 0.0});
  tallies.add("fine", Outcome::planner_error,
              std::vector{0.0, std::nan(""), 0.0, 0.0});  // never called
  const auto& counts = tallies.by_planner();
  EXPECT_EQ(counts.at("blind").trials, 3);
  EXPECT_EQ(counts.at("blind").standing, 2);
  EXPECT_EQ(counts.at("blind").silent, 1);
  EXPECT_EQ(counts.at("fine").standing, 0);
  EXPECT_EQ(counts.at("fine").silent, 0);
  const auto warnings = tallies.warnings({{"none", "None"}, {"fine", "F"}, {"blind", "B"}}, "{}");
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(warnings[0].starts_with(
      "B hovered until the time limit in 2 of 3 trials (mean speed below 0.1 m/s)"))
      << warnings[0];
  EXPECT_EQ(warnings[1], "B gave no command at all in 1 of 3 trials");
}

TEST(PlannerTallies, SumUpNothingWhereAMetricIsMissing) {
  std::vector<std::string> names = kTimes;
  names.back() = "mean_speed_mps";
  PlannerTallies tallies(metrics(names));
  tallies.add("a", Outcome::timed_out, std::vector<double>{10.0, 1.0, 100.0, 14.0, 0.01});
  EXPECT_EQ(tallies.by_planner().at("a").calls, 0.0);
  EXPECT_EQ(tallies.by_planner().at("a").standing, 0);
  EXPECT_TRUE(tallies.warnings({{"a", "a"}}, "{}").empty());
}

TEST(TimeDemand, IsWhatEveryTrialFlewWith) {
  const TimeDemand fixed = time_demand(
      R"({"base":{"latency":{"mode":"fixed","ms":40.0},"rates":{"plan_hz":20.0}},"axes":[]})");
  EXPECT_FALSE(fixed.is_charged);
  EXPECT_NEAR(fixed.latency_s, 0.04, 1e-12);
  EXPECT_NEAR(fixed.plan_period_s, 0.05, 1e-12);
  const TimeDemand several =
      time_demand(R"({"base":{"latency":{"mode":"fixed","ms":40.0},"rates":{"plan_hz":20.0}},)"
                  R"("axes":[{"path":"latency.ms"},{"path":"rates.plan_hz"}]})");
  EXPECT_EQ(several.latency_s, 0.0);
  EXPECT_EQ(several.plan_period_s, 0.0);
  for (const char* mode : {"measured", "replay"}) {
    const TimeDemand charged =
        time_demand(R"({"base":{"latency":{"ms":40.0,"mode":")" + std::string(mode) + R"("}}})");
    EXPECT_TRUE(charged.is_charged) << mode;
    EXPECT_EQ(charged.latency_s, 0.0);
  }
  EXPECT_EQ(time_demand("[]").plan_period_s, 0.0);
}

}  // namespace
}  // namespace avoidbench
