// Whether intervals of 95 % hold the truth in 93 to 97 % of synthetic sweeps, whose maps differ.

#include <gtest/gtest.h>

#include <iostream>

#include "statistics/ranks.hpp"
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

// Since ends that the draws can't tell are unknown: 89 to 91 % for five maps without that.
TEST(StatisticsSlow, FiveAndEightMapsAreNearlyEnough) {
  const BootstrapCoverage five = synthetic::bootstrap_coverage({}, 5, 1000, 1000);
  const BootstrapCoverage eight = synthetic::bootstrap_coverage({}, 8, 1000, 1000);
  std::cout << "    mean " << five.mean.percent() << " %, " << eight.mean.percent()
            << " %, contrast factor " << five.contrast.percent() << " %, "
            << eight.contrast.percent() << " %\n";
  for (const Coverage& coverage : {five.mean, five.contrast, eight.mean, eight.contrast}) {
    EXPECT_GE(coverage.percent(), 91.5);
    EXPECT_LE(coverage.percent(), 97.5);
  }
}

// Two planners of the same rate over all maps, each better on maps of its own: how often a test
// of 5 % says that they differ.
TEST(StatisticsSlow, TestsOfMapsKeepTheirLevelWhereTestsOfTrialsDoNot) {
  Population population;
  population.logit = {1.5, 1.5};
  population.logit_spread = 1.5;
  constexpr int kSweeps = 4000;
  RandomStream random = stream(6, "sweeps");
  int mcnemar = 0, fisher = 0, wilcoxon = 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const std::vector<synthetic::Map> maps = synthetic::flown(population, 30, random);
    std::array<std::int64_t, 2> finished{}, only{};
    std::vector<double> differences;
    for (const synthetic::Map& map : maps) {
      for (std::size_t trial = 0; trial < map.successes[0].size(); ++trial) {
        only[0] += map.successes[0][trial] && !map.successes[1][trial] ? 1 : 0;
        only[1] += map.successes[1][trial] && !map.successes[0][trial] ? 1 : 0;
      }
      finished[0] += map.finished[0];
      finished[1] += map.finished[1];
      differences.push_back(static_cast<double>(map.finished[0] - map.finished[1]));
    }
    mcnemar += mcnemar_exact_p(only[0], only[1]) < 0.05 ? 1 : 0;
    fisher += fisher_exact_p(finished[0], 300, finished[1], 300) < 0.05 ? 1 : 0;
    wilcoxon += wilcoxon_signed_rank(differences).p < 0.05 ? 1 : 0;
  }
  std::cout << "    Wilcoxon of maps' rates " << 100.0 * wilcoxon / kSweeps << " %, McNemar "
            << 100.0 * mcnemar / kSweeps << " %, Fisher " << 100.0 * fisher / kSweeps << " %\n";
  EXPECT_LE(wilcoxon, 0.06 * kSweeps);
  EXPECT_GE(wilcoxon, 0.03 * kSweeps);
  EXPECT_GT(mcnemar, 0.08 * kSweeps);
  EXPECT_GT(fisher, 0.08 * kSweeps);
}

}  // namespace
}  // namespace avoidbench
