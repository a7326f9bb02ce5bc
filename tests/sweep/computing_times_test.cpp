#include "sweep/computing_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace avoidbench {
namespace {

std::vector<MetricRow> time_metrics() {
  std::vector<MetricRow> rows;
  // In an order of their own, beside another.
  for (const char* name : {"processing_time_ms", "finished", "plan_call_count",
                           "processing_wall_time_ms", "deadline_miss_count"}) {
    rows.emplace_back().name = name;
  }
  return rows;
}

TEST(ComputingTimes, AreMeansOverAllCallsOfAPlanner) {
  const std::vector<MetricRow> metrics = time_metrics();
  ComputingTimes times(metrics);
  times.add("a", std::vector<double>{10.0, 1.0, 100.0, 14.0, 5.0});
  times.add("b", std::vector<double>{3.0, 1.0, 7.0, 4.0, 1.0});
  times.add("a", std::vector<double>{40.0, 0.0, 300.0, 50.0, 20.0});
  times.add("a", std::vector<double>{std::nan(""), 0.0, 0.0, std::nan(""), 0.0});  // no call
  times.add("c", std::vector<double>{std::nan(""), 0.0, 8.0, std::nan(""), std::nan("")});
  const std::map<std::string, CallTimes> found = times.by_planner();
  ASSERT_EQ(found.size(), 2U) << "of c nobody measured times";
  const CallTimes& a = found.at("a");
  EXPECT_EQ(a.count, 400);
  EXPECT_EQ(a.late_count, 25);
  EXPECT_NEAR(a.cpu_s, 1e-3 * (100.0 * 10.0 + 300.0 * 40.0) / 400.0, 1e-12);
  EXPECT_NEAR(a.wall_s, 1e-3 * (100.0 * 14.0 + 300.0 * 50.0) / 400.0, 1e-12);
  EXPECT_EQ(found.at("b").count, 7);
  EXPECT_NEAR(found.at("b").wall_s, 4e-3, 1e-12);
}

TEST(ComputingTimes, AreNoneWhereAMetricIsMissing) {
  std::vector<MetricRow> metrics = time_metrics();
  metrics.pop_back();
  ComputingTimes times(metrics);
  times.add("a", std::vector<double>{10.0, 1.0, 100.0, 14.0});
  EXPECT_TRUE(times.by_planner().empty());
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
