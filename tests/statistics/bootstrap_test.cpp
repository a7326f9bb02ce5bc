#include "statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace avoidbench {
namespace {

TEST(Bootstrap, ContrastFactorIsTheRatioOfFailuresAMetre) {
  // Failures of intensity λ a metre: SR = exp(-λ d).
  const double one = std::exp(-0.02 * 30.0);
  const double two = std::exp(-0.01 * 50.0);
  EXPECT_NEAR(contrast_factor(one, 30.0, two, 50.0), 2.0, 1e-12);
  EXPECT_NEAR(contrast_factor(two, 50.0, one, 30.0), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(contrast_factor(1.0, 30.0, 0.5, 30.0)));
  EXPECT_TRUE(std::isnan(contrast_factor(0.5, 30.0, 0.0, 30.0)));
}

TEST(Bootstrap, QuantilesAreLinearBetweenOrderStatistics) {
  const std::vector<double> values{4, 1, 3, 2};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 1.0), 4.0);
  EXPECT_EQ(quantile(values, 0.5), 2.5);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Bootstrap, BootstrapOfAMeanHasItsSpread) {
  std::vector<double> values;
  RandomStream random(5);
  for (int i = 0; i < 400; ++i) values.push_back(random.normal());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / 400.0;
  const auto mean_of = [&](std::span<const std::size_t> drawn) {
    double total = 0.0;
    for (const std::size_t i : drawn) total += values[i];
    return total / static_cast<double>(drawn.size());
  };
  const Interval interval = bca_interval(values.size(), mean_of, stream(1, "test"));
  EXPECT_NEAR(interval.lower, mean - 1.96 / 20.0, 0.015);
  EXPECT_NEAR(interval.upper, mean + 1.96 / 20.0, 0.015);
  const Interval again = bca_interval(values.size(), mean_of, stream(1, "test"));
  EXPECT_EQ(interval.lower, again.lower);
  EXPECT_EQ(interval.upper, again.upper);
}

}  // namespace
}  // namespace avoidbench
