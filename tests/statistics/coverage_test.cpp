// Whether intervals of 95 % hold the truth in 93 to 97 % of synthetic sweeps, whose maps differ.

#include <gtest/gtest.h>

#include <iostream>

#include "synthetic_sweeps.hpp"

namespace avoidbench {
namespace {

using synthetic::BootstrapCoverage;
using synthetic::Coverage;
using synthetic::Population;
using synthetic::RateCoverage;

void expect_honest(const Coverage& coverage, const char* name) {
  std::cout << "    " << name << ": " << coverage.percent() << " %\n";
  EXPECT_GE(coverage.percent(), 93.0) << name;
  EXPECT_LE(coverage.percent(), 97.0) << name;
}

void expect_too_sure(const Coverage& coverage, const char* name) {
  std::cout << "    " << name << ": " << coverage.percent() << " %\n";
  EXPECT_LT(coverage.percent(), 93.0) << name;
}

TEST(StatisticsCoverage, RatesOfFifteenMaps) {
  const RateCoverage coverage = synthetic::rate_coverage({}, 15, 1000);
  expect_honest(coverage.clustered, "clustered Wilson");
  expect_too_sure(coverage.wilson, "Wilson, for all maps");
  EXPECT_GE(coverage.wilson_of_flown.percent(), 94.0);
}

TEST(StatisticsCoverage, MeansAndContrastsOfFifteenMaps) {
  const BootstrapCoverage coverage = synthetic::bootstrap_coverage({}, 15, 1000, 500);
  expect_honest(coverage.mean, "mean over maps");
  expect_honest(coverage.contrast, "contrast factor over maps");
  expect_too_sure(coverage.naive_mean, "mean over trials");
  expect_too_sure(coverage.naive_contrast, "contrast factor over trials");
}

TEST(StatisticsSlow, RatesCover) {
  for (const int map_count : {15, 30}) {
    for (const double spread : {0.5, 1.0, 2.0}) {
      for (const double logit : {0.0, 1.5, 2.5}) {
        Population population;
        population.logit[0] = logit;
        population.logit_spread = spread;
        std::cout << map_count << " maps, logits " << logit << " ± " << spread << " (rate "
                  << population.mean_rate(0) << ")\n";
        const RateCoverage coverage = synthetic::rate_coverage(population, map_count, 10000);
        expect_honest(coverage.clustered, "clustered Wilson");
        std::cout << "    Wilson, for all maps: " << coverage.wilson.percent()
                  << " %, for those flown: " << coverage.wilson_of_flown.percent() << " %\n";
        // For the maps flown it is right, and too careful where they differ much: its variance
        // is that of trials of one rate.
        EXPECT_GE(coverage.wilson_of_flown.percent(), 93.0);
        if (spread >= 1.0) {
          EXPECT_LT(coverage.wilson.percent(), 90.0);
        }
        if (spread <= 0.5) {
          EXPECT_LE(coverage.wilson_of_flown.percent(), 97.0);
        }
      }
    }
  }
}

TEST(StatisticsSlow, WilsonCoversWhereMapsAreAlike) {
  Population population;
  population.logit_spread = 0.0;
  for (const int map_count : {15, 30}) {
    const RateCoverage coverage = synthetic::rate_coverage(population, map_count, 2000);
    expect_honest(coverage.wilson, "Wilson");
    // Never narrower than Wilson's, and with t: careful.
    EXPECT_GE(coverage.clustered.percent(), 95.0);
    EXPECT_LE(coverage.clustered.percent(), 98.5);
  }
}

TEST(StatisticsSlow, MeansAndContrastsCover) {
  for (const int map_count : {15, 30}) {
    for (const double spread : {0.5, 1.0, 1.5}) {
      Population population;
      population.logit_spread = spread;
      std::cout << map_count << " maps, logits ± " << spread << "\n";
      const BootstrapCoverage coverage =
          synthetic::bootstrap_coverage(population, map_count, 2000, 1000);
      expect_honest(coverage.mean, "mean over maps");
      expect_honest(coverage.contrast, "contrast factor over maps");
      expect_too_sure(coverage.naive_mean, "mean over trials");
      if (spread >= 1.0) {  // a little of maps' differences cancels in the ratio of planners
        expect_too_sure(coverage.naive_contrast, "contrast factor over trials");
      }
    }
  }
}

// Means of heavy tails need more maps: of lognormal ones (skewness 2.3) 15 are too few.
TEST(StatisticsSlow, SkewedMeansNeedMoreMaps) {
  Population population;
  population.is_skewed = true;
  population.logit[0] = 6.0;       // nearly all finish
  population.metric_spread = 0.3;  // skewness 0.9
  expect_honest(synthetic::mean_coverage(population, 15, 2000, 1000), "mild, 15 maps");
  population.metric_spread = 0.6;
  const Coverage few = synthetic::mean_coverage(population, 15, 2000, 1000);
  std::cout << "    strong, 15 maps: " << few.percent() << " %\n";
  EXPECT_GE(few.percent(), 90.0);
  EXPECT_LT(few.percent(), 93.0);
  expect_honest(synthetic::mean_coverage(population, 60, 2000, 1000), "strong, 60 maps");
}

}  // namespace
}  // namespace avoidbench
