#include "statistics/rates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"
#include "statistics/distributions.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

/// Wilson's interval of a rate seen in `trials` trials, with the normal quantile `z`.
Interval score_interval(double rate, double trials, double z) {
  const double scale = 1.0 / (1.0 + z * z / trials);
  const double centre = scale * (rate + 0.5 * z * z / trials);
  const double half =
      scale * z * std::sqrt(rate * (1.0 - rate) / trials + 0.25 * z * z / (trials * trials));
  // Exactly 0 and 1 at the ends, which the formula misses by rounding.
  return {rate <= 0.0 ? 0.0 : std::max(0.0, centre - half),
          rate >= 1.0 ? 1.0 : std::min(1.0, centre + half)};
}

void check_counts(std::int64_t successes, std::int64_t trials) {
  AB_CHECK(successes >= 0 && successes <= trials, successes, trials);
}

}  // namespace

Interval wilson_interval(std::int64_t successes, std::int64_t trials, double confidence) {
  check_counts(successes, trials);
  if (trials == 0) return {kNaN, kNaN};
  const auto n = static_cast<double>(trials);
  return score_interval(static_cast<double>(successes) / n, n,
                        normal_quantile(0.5 + 0.5 * confidence));
}

Interval clopper_pearson_interval(std::int64_t successes, std::int64_t trials, double confidence) {
  check_counts(successes, trials);
  if (trials == 0) return {kNaN, kNaN};
  const double tail = 0.5 - 0.5 * confidence;
  const auto k = static_cast<double>(successes);
  const auto failures = static_cast<double>(trials - successes);
  return {successes == 0 ? 0.0 : beta_quantile(tail, k, failures + 1.0),
          successes == trials ? 1.0 : beta_quantile(1.0 - tail, k + 1.0, failures)};
}

Interval poisson_interval(std::int64_t count, double confidence) {
  AB_CHECK(count >= 0, count);
  const double tail = 0.5 - 0.5 * confidence;
  const auto k = static_cast<double>(count);
  return {count == 0 ? 0.0 : gamma_quantile(tail, k), gamma_quantile(1.0 - tail, k + 1.0)};
}

Interval jeffreys_interval(std::int64_t successes, std::int64_t trials, double confidence) {
  check_counts(successes, trials);
  if (trials == 0) return {kNaN, kNaN};
  const double tail = 0.5 - 0.5 * confidence;
  const double a = static_cast<double>(successes) + 0.5;
  const double b = static_cast<double>(trials - successes) + 0.5;
  return {successes == 0 ? 0.0 : beta_quantile(tail, a, b),
          successes == trials ? 1.0 : beta_quantile(1.0 - tail, a, b)};
}

void ClusterSums::add(std::int64_t cluster_successes, std::int64_t cluster_trials) {
  check_counts(cluster_successes, cluster_trials);
  if (cluster_trials == 0) return;
  clusters += 1;
  trials += cluster_trials;
  successes += cluster_successes;
  success_squares += cluster_successes * cluster_successes;
  products += cluster_successes * cluster_trials;
  trial_squares += cluster_trials * cluster_trials;
}

Interval clustered_wilson_interval(const ClusterSums& sums, double t) {
  if (sums.clusters < 2) return {kNaN, kNaN};
  const auto clusters = static_cast<double>(sums.clusters);
  const auto n = static_cast<double>(sums.trials);
  const double rate = static_cast<double>(sums.successes) / n;
  double effective = n;
  if (rate > 0.0 && rate < 1.0) {
    // The rate is a ratio of two sums over clusters: the linearised variance is that of the
    // residuals s - rate n.
    const double squares = static_cast<double>(sums.success_squares) -
                           2.0 * rate * static_cast<double>(sums.products) +
                           rate * rate * static_cast<double>(sums.trial_squares);
    const double variance = clusters / (clusters - 1.0) * squares / (n * n);
    // The design effect: how much larger the variance between clusters is than that of independent
    // trials. Never below 1, since that is chance.
    effective = n / std::max(1.0, variance / (rate * (1.0 - rate) / n));
  }
  // As many independent trials as would be as certain.
  return score_interval(rate, effective, t);
}

Interval clustered_wilson_interval(std::span<const std::int64_t> successes,
                                   std::span<const std::int64_t> trials, double confidence) {
  AB_CHECK(successes.size() == trials.size(), successes.size(), trials.size());
  ClusterSums sums;
  for (std::size_t i = 0; i < trials.size(); ++i) sums.add(successes[i], trials[i]);
  if (sums.clusters < 2) return {kNaN, kNaN};
  return clustered_wilson_interval(
      sums, student_t_quantile(0.5 + 0.5 * confidence, static_cast<double>(sums.clusters) - 1.0));
}

Interval rate_interval(std::span<const std::int64_t> successes,
                       std::span<const std::int64_t> trials, double confidence) {
  const auto flown = std::count_if(trials.begin(), trials.end(), [](auto n) { return n > 0; });
  if (flown >= static_cast<std::ptrdiff_t>(kLeastMaps)) {
    return clustered_wilson_interval(successes, trials, confidence);
  }
  return wilson_interval(std::accumulate(successes.begin(), successes.end(), std::int64_t{0}),
                         std::accumulate(trials.begin(), trials.end(), std::int64_t{0}),
                         confidence);
}

double jeffreys_rate(std::int64_t successes, std::int64_t trials) {
  return (static_cast<double>(successes) + 0.5) / (static_cast<double>(trials) + 1.0);
}

double fisher_exact_p(std::int64_t successes_1, std::int64_t trials_1, std::int64_t successes_2,
                      std::int64_t trials_2) {
  AB_CHECK(successes_1 >= 0 && successes_1 <= trials_1 && successes_2 >= 0 &&
           successes_2 <= trials_2);
  const std::int64_t trials = trials_1 + trials_2;
  const std::int64_t successes = successes_1 + successes_2;
  // In logarithms: factorials of hundreds of trials overflow.
  std::vector<double> log_factorial(static_cast<std::size_t>(trials) + 1, 0.0);
  for (std::size_t i = 2; i < log_factorial.size(); ++i) {
    log_factorial[i] = log_factorial[i - 1] + math::log(static_cast<double>(i));
  }
  const auto log_choose = [&](std::int64_t n, std::int64_t k) {
    return log_factorial[static_cast<std::size_t>(n)] - log_factorial[static_cast<std::size_t>(k)] -
           log_factorial[static_cast<std::size_t>(n - k)];
  };
  // Probability that k of the successes fall to the first.
  const auto probability = [&](std::int64_t k) {
    return math::exp(log_choose(trials_1, k) + log_choose(trials_2, successes - k) -
                     log_choose(trials, successes));
  };
  const double seen = probability(successes_1);
  double p = 0.0;
  // All tables with the same margins.
  for (std::int64_t k = std::max<std::int64_t>(0, successes - trials_2);
       k <= std::min(trials_1, successes); ++k) {
    const double other = probability(k);
    // Tables as likely as the one seen count; the factor covers their rounding, as in R.
    if (other <= seen * (1.0 + 1e-7)) p += other;
  }
  return std::min(1.0, p);
}

double mcnemar_exact_p(std::int64_t only_first, std::int64_t only_second) {
  AB_CHECK(only_first >= 0 && only_second >= 0, only_first, only_second);
  // Of the missions that differ, half would go either way by chance.
  const auto fewer = static_cast<double>(std::min(only_first, only_second));
  const auto both = static_cast<double>(only_first + only_second);
  return std::min(1.0, 2.0 * binomial_cdf(fewer, both, 0.5));
}

}  // namespace avoidbench
