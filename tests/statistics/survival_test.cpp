#include "statistics/survival.hpp"

#include "reference.hpp"

namespace avoidbench {
namespace {

TEST(Survival, ByTheDefinition) {
  for (const auto& row : reference("survival")) {
    const std::vector<std::int64_t> flags = counts(row.at("is_event"));
    const std::vector<bool> is_event(flags.begin(), flags.end());
    const auto points = kaplan_meier(numbers(row.at("times_s")), is_event);
    ASSERT_EQ(points.size(), row.at("points").size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& expected = row.at("points")[i];
      EXPECT_EQ(points[i].time_s, expected.at("time_s").get<double>());
      EXPECT_EQ(points[i].at_risk, expected.at("at_risk").get<std::int64_t>());
      EXPECT_EQ(points[i].events, expected.at("events").get<std::int64_t>());
      EXPECT_NEAR(points[i].survival, expected.at("survival").get<double>(), 1e-13);
      const std::vector<double> ends = numbers(expected.at("interval"));
      expect_close(points[i].interval.lower, ends[0]);
      expect_close(points[i].interval.upper, ends[1]);
    }
  }
}

// Weeks of remission with 6-MP (Freireich et al. 1963), the table of many textbooks, with the
// intervals that Stata's `sts list` prints.
TEST(Survival, RemissionOfLeukaemiaAsPublished) {
  const std::vector<double> weeks{6,  6,  6,  6,  7,  9,  10, 10, 11, 13, 16,
                                  17, 19, 20, 22, 23, 25, 32, 32, 34, 35};
  const std::vector<bool> is_event{true,  true,  true,  false, true,  false, true,
                                   false, false, true,  true,  false, false, false,
                                   true,  true,  false, false, false, false, false};
  const auto points = kaplan_meier(weeks, is_event);
  const std::vector<double> times{6, 7, 10, 13, 16, 22, 23};
  const std::vector<std::int64_t> at_risk{21, 17, 15, 12, 11, 7, 6};
  const std::vector<double> survival{0.8571, 0.8067, 0.7529, 0.6902, 0.6275, 0.5378, 0.4482};
  const std::vector<double> lower{0.6197, 0.5631, 0.5032, 0.4316, 0.3675, 0.2678, 0.1881};
  const std::vector<double> upper{0.9516, 0.9228, 0.8894, 0.8491, 0.8049, 0.7468, 0.6801};
  ASSERT_EQ(points.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(points[i].time_s, times[i]);
    EXPECT_EQ(points[i].at_risk, at_risk[i]);
    EXPECT_NEAR(points[i].survival, survival[i], 6e-5);
    EXPECT_NEAR(points[i].interval.lower, lower[i], 6e-5);
    EXPECT_NEAR(points[i].interval.upper, upper[i], 6e-5);
  }
  EXPECT_EQ(survival_quantile(points, 0.5), 23);
  EXPECT_EQ(survival_quantile(points, 0.25), 13);
  EXPECT_EQ(survival_quantile(points, 0.9), std::numeric_limits<double>::infinity());
}

TEST(Survival, WithoutCensoringItIsTheShareLeft) {
  std::vector<double> times;
  for (int i = 10; i >= 1; --i) times.push_back(i);
  const auto points = kaplan_meier(times, std::vector<bool>(10, true));
  ASSERT_EQ(points.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(points[i].survival, 0.1 * static_cast<double>(9 - i), 1e-14);
  }
  EXPECT_TRUE(std::isnan(points.back().interval.lower));
  EXPECT_EQ(survival_quantile(points, 0.5), 5.0);  // in spite of the product's rounding
  EXPECT_EQ(survival_quantile(points, 1.0), 10.0);
}

TEST(Survival, WithoutEventsThereIsNoStep) {
  EXPECT_TRUE(kaplan_meier(std::vector<double>{3, 4}, {false, false}).empty());
  EXPECT_TRUE(kaplan_meier({}, {}).empty());
  EXPECT_EQ(survival_quantile({}, 0.5), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace avoidbench
