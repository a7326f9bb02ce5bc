#include "report/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace avoidbench {
namespace {

TEST(Statistics, WilsonIntervalsWorkedByHand) {
  EXPECT_NEAR(wilson_interval(10, 10).lower, 0.722, 5e-4);
  EXPECT_EQ(wilson_interval(10, 10).upper, 1.0);
  EXPECT_NEAR(wilson_interval(6, 10).lower, 0.313, 5e-4);
  EXPECT_NEAR(wilson_interval(6, 10).upper, 0.832, 5e-4);
  EXPECT_NEAR(wilson_interval(2, 10).lower, 0.057, 5e-4);
  EXPECT_NEAR(wilson_interval(2, 10).upper, 0.510, 5e-4);
  EXPECT_EQ(wilson_interval(0, 10).lower, 0.0);
  EXPECT_TRUE(std::isnan(wilson_interval(0, 0).lower));
}

TEST(Statistics, WilsonIntervalMirrors) {
  for (int k = 0; k <= 17; ++k) {
    const Interval a = wilson_interval(k, 17);
    const Interval b = wilson_interval(17 - k, 17);
    EXPECT_NEAR(a.lower, 1.0 - b.upper, 1e-15);
    EXPECT_LE(a.lower, k / 17.0);
    EXPECT_GE(a.upper, k / 17.0);
  }
}

TEST(Statistics, FisherWorkedByHand) {
  EXPECT_NEAR(fisher_exact_p(6, 10, 2, 10), 0.170, 5e-4);
  EXPECT_NEAR(fisher_exact_p(10, 10, 6, 10), 0.087, 5e-4);
  EXPECT_NEAR(fisher_exact_p(9, 10, 2, 10), 0.0055, 5e-5);
  EXPECT_NEAR(fisher_exact_p(3, 4, 1, 4), 34.0 / 70.0, 1e-12);  // the lady tasting tea
  EXPECT_NEAR(fisher_exact_p(5, 10, 5, 10), 1.0, 1e-12);
  EXPECT_EQ(fisher_exact_p(0, 0, 5, 10), 1.0);
  EXPECT_NEAR(fisher_exact_p(7, 12, 3, 20), fisher_exact_p(3, 20, 7, 12), 1e-14);
}

TEST(Statistics, TrialsNeeded) {
  EXPECT_EQ(std::round(two_rates_trials(0.90, 0.80)), 199);
  EXPECT_EQ(std::round(two_rates_trials(0.60, 0.50)), 387);
  EXPECT_EQ(std::ceil(hoeffding_trials(0.05, 0.99)), 1060);
}

TEST(Statistics, JeffreysRateIsNeverSure) {
  EXPECT_EQ(jeffreys_rate(0, 9), 0.05);
  EXPECT_EQ(jeffreys_rate(9, 9), 0.95);
}

TEST(Statistics, SpearmanSeesOnlyOrder) {
  const std::vector<double> x{1, 2, 3, 4, 5};
  const std::vector<double> cubes{1, 8, 27, 64, 125};
  EXPECT_NEAR(spearman_correlation(x, cubes), 1.0, 1e-15);
  const std::vector<double> falling{5, 4, 3, 2, 1};
  EXPECT_NEAR(spearman_correlation(x, falling), -1.0, 1e-15);
  // 1 - 6 Σd²/(n(n²-1)) without ties: d = 1 1 1 1 0.
  const std::vector<double> swapped{2, 1, 4, 3, 5};
  EXPECT_NEAR(spearman_correlation(x, swapped), 0.8, 1e-15);
  // Ties have average ranks: 1.5 1.5 3 against 1 2 3.
  const std::vector<double> tied{7, 7, 9}, other{1, 2, 3};
  EXPECT_NEAR(spearman_correlation(tied, other), 1.5 / std::sqrt(1.5 * 2.0), 1e-15);
  const std::vector<double> constant{4, 4, 4};
  EXPECT_TRUE(std::isnan(spearman_correlation(constant, other)));
}

TEST(Statistics, WilcoxonSeesShiftsOnly) {
  std::vector<double> shifted, symmetric;
  for (int i = 1; i <= 20; ++i) {
    shifted.push_back(i);
    symmetric.push_back(i % 2 == 0 ? i : -i);
  }
  // All 20 positive: W = 210, mean 105, variance 20·21·41/24 = 717.5.
  EXPECT_NEAR(wilcoxon_z(shifted), 104.5 / std::sqrt(717.5), 1e-12);
  EXPECT_LT(std::abs(wilcoxon_z(symmetric)), 0.5);
  for (double& value : shifted) value = -value;
  EXPECT_NEAR(wilcoxon_z(shifted), -104.5 / std::sqrt(717.5), 1e-12);
  shifted.resize(9);
  EXPECT_EQ(wilcoxon_z(shifted), 0.0);
}

TEST(Statistics, ContrastFactorIsTheRatioOfFailuresAMetre) {
  // Failures of intensity λ a metre: SR = exp(-λ d).
  const double one = std::exp(-0.02 * 30.0);
  const double two = std::exp(-0.01 * 50.0);
  EXPECT_NEAR(contrast_factor(one, 30.0, two, 50.0), 2.0, 1e-12);
  EXPECT_NEAR(contrast_factor(two, 50.0, one, 30.0), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(contrast_factor(1.0, 30.0, 0.5, 30.0)));
  EXPECT_TRUE(std::isnan(contrast_factor(0.5, 30.0, 0.0, 30.0)));
}

TEST(Statistics, QuantilesAreLinearBetweenOrderStatistics) {
  const std::vector<double> values{4, 1, 3, 2};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 1.0), 4.0);
  EXPECT_EQ(quantile(values, 0.5), 2.5);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Statistics, BootstrapOfAMeanHasItsSpread) {
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
  const Interval interval = bootstrap_interval(values.size(), mean_of, stream(1, "test"));
  EXPECT_NEAR(interval.lower, mean - 1.96 / 20.0, 0.015);
  EXPECT_NEAR(interval.upper, mean + 1.96 / 20.0, 0.015);
  const Interval again = bootstrap_interval(values.size(), mean_of, stream(1, "test"));
  EXPECT_EQ(interval.lower, again.lower);
  EXPECT_EQ(interval.upper, again.upper);
}

}  // namespace
}  // namespace avoidbench
