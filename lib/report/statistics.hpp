#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "base/random.hpp"

namespace avoidbench {

struct Interval {
  double lower = 0.0;
  double upper = 0.0;
};

/// Interval for a rate (Wilson 1927): keeps its confidence for few trials and at rates 0 and 1. NaN
/// without trials.
Interval wilson_interval(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

/// (successes + 1/2) / (trials + 1): never 0 or 1, so that its logarithm can be taken.
double jeffreys_rate(std::int64_t successes, std::int64_t trials);

/// Two-sided p of Fisher's exact test that two rates are equal: the sum of the probabilities of all
/// tables with these margins that are no likelier than the one seen.
double fisher_exact_p(std::int64_t successes_1, std::int64_t trials_1, std::int64_t successes_2,
                      std::int64_t trials_2);

/// z of Wilcoxon's signed-rank test that paired differences are symmetric about 0: normal
/// approximation with average ranks, tie and continuity corrections; zeros are left out. Positive
/// where differences tend to be. 0 for fewer than 10 differences, where the approximation is bad:
/// nothing can be told then.
double wilcoxon_z(std::span<const double> differences);

/// Trials after which a rate is within `half_width` of the truth with this confidence, whatever it
/// is (Hoeffding 1963); round up.
double hoeffding_trials(double half_width, double confidence);

/// Trials a planner to tell success rates `rate_1` and `rate_2` apart by a two-sided test of level
/// `alpha` with this power (pooled variance under the hypothesis of equality); round up.
double two_rates_trials(double rate_1, double rate_2, double power = 0.8, double alpha = 0.05);

/// Spearman's rank correlation, ties with their average rank; NaN for fewer than 2 pairs or where
/// one side is constant.
double spearman_correlation(std::span<const double> x, std::span<const double> y);

/// The `ratio` quantile, linear between the values' order statistics; NaN without values.
double quantile(std::span<const double> values, double ratio);

/// CF = (d_2 ln SR_1) / (d_1 ln SR_2), AvoidBench (arXiv 2301.07430) eq. (10): failures a metre of
/// 1 over those of 2. NaN where a rate is 0 or 1.
double contrast_factor(double success_rate_1, double reference_length_1_m, double success_rate_2,
                       double reference_length_2_m);

/// Percentile interval of a statistic of `cluster_count` clusters (maps): `statistic` gets the
/// clusters drawn with replacement, in each of `replicate_count` draws. Draws where it is NaN are
/// left out; NaN where none is left.
Interval bootstrap_interval(std::size_t cluster_count,
                            const std::function<double(std::span<const std::size_t>)>& statistic,
                            RandomStream random, std::size_t replicate_count = 2000,
                            double confidence = 0.95);

}  // namespace avoidbench
