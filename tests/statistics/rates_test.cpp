#include "statistics/rates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace avoidbench {
namespace {

TEST(Rates, WilsonIntervalsWorkedByHand) {
  EXPECT_NEAR(wilson_interval(10, 10).lower, 0.722, 5e-4);
  EXPECT_EQ(wilson_interval(10, 10).upper, 1.0);
  EXPECT_NEAR(wilson_interval(6, 10).lower, 0.313, 5e-4);
  EXPECT_NEAR(wilson_interval(6, 10).upper, 0.832, 5e-4);
  EXPECT_NEAR(wilson_interval(2, 10).lower, 0.057, 5e-4);
  EXPECT_NEAR(wilson_interval(2, 10).upper, 0.510, 5e-4);
  EXPECT_EQ(wilson_interval(0, 10).lower, 0.0);
  EXPECT_TRUE(std::isnan(wilson_interval(0, 0).lower));
}

TEST(Rates, WilsonIntervalMirrors) {
  for (int k = 0; k <= 17; ++k) {
    const Interval a = wilson_interval(k, 17);
    const Interval b = wilson_interval(17 - k, 17);
    EXPECT_NEAR(a.lower, 1.0 - b.upper, 1e-15);
    EXPECT_LE(a.lower, k / 17.0);
    EXPECT_GE(a.upper, k / 17.0);
  }
}

TEST(Rates, FisherWorkedByHand) {
  EXPECT_NEAR(fisher_exact_p(6, 10, 2, 10), 0.170, 5e-4);
  EXPECT_NEAR(fisher_exact_p(10, 10, 6, 10), 0.087, 5e-4);
  EXPECT_NEAR(fisher_exact_p(9, 10, 2, 10), 0.0055, 5e-5);
  EXPECT_NEAR(fisher_exact_p(3, 4, 1, 4), 34.0 / 70.0, 1e-12);  // the lady tasting tea
  EXPECT_NEAR(fisher_exact_p(5, 10, 5, 10), 1.0, 1e-12);
  EXPECT_EQ(fisher_exact_p(0, 0, 5, 10), 1.0);
  EXPECT_NEAR(fisher_exact_p(7, 12, 3, 20), fisher_exact_p(3, 20, 7, 12), 1e-14);
}

TEST(Rates, JeffreysRateIsNeverSure) {
  EXPECT_EQ(jeffreys_rate(0, 9), 0.05);
  EXPECT_EQ(jeffreys_rate(9, 9), 0.95);
}

}  // namespace
}  // namespace avoidbench
