#include "report/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"

namespace avoidbench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Ranks from 1, ties with their average.
std::vector<double> average_ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    const double rank = 1.0 + 0.5 * static_cast<double>(first + last);
    for (std::size_t i = first; i <= last; ++i) ranks[order[i]] = rank;
    first = last + 1;
  }
  return ranks;
}

}  // namespace

Interval wilson_interval(std::int64_t successes, std::int64_t trials, double confidence) {
  if (trials == 0) return {kNaN, kNaN};
  const auto n = static_cast<double>(trials);
  const double rate = static_cast<double>(successes) / n;
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  const double scale = 1.0 / (1.0 + z * z / n);
  const double centre = scale * (rate + 0.5 * z * z / n);
  const double half = scale * z * std::sqrt(rate * (1.0 - rate) / n + 0.25 * z * z / (n * n));
  return {successes == 0 ? 0.0 : std::max(0.0, centre - half),
          successes == trials ? 1.0 : std::min(1.0, centre + half)};
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
  for (std::int64_t k = std::max<std::int64_t>(0, successes - trials_2);
       k <= std::min(trials_1, successes); ++k) {
    const double other = probability(k);
    if (other <= seen * (1.0 + 1e-7)) p += other;
  }
  return std::min(1.0, p);
}

double wilcoxon_z(std::span<const double> differences) {
  std::vector<double> sizes;
  std::vector<bool> is_positive;
  for (const double difference : differences) {
    if (difference == 0.0 || difference != difference) continue;
    sizes.push_back(std::abs(difference));
    is_positive.push_back(difference > 0.0);
  }
  if (sizes.size() < 10) return 0.0;
  const std::vector<double> ranks = average_ranks(sizes);
  double positive_sum = 0.0;
  double variance = 0.0;  // Σ rank²/4 holds with ties too
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (is_positive[i]) positive_sum += ranks[i];
    variance += 0.25 * ranks[i] * ranks[i];
  }
  const auto n = static_cast<double>(sizes.size());
  const double distance = positive_sum - 0.25 * n * (n + 1.0);
  const double corrected = std::max(0.0, std::abs(distance) - 0.5) / std::sqrt(variance);
  return distance < 0.0 ? -corrected : corrected;
}

double hoeffding_trials(double half_width, double confidence) {
  return math::log(2.0 / (1.0 - confidence)) / (2.0 * half_width * half_width);
}

double two_rates_trials(double rate_1, double rate_2, double power, double alpha) {
  const double mean = 0.5 * (rate_1 + rate_2);
  const double equal = normal_quantile(1.0 - 0.5 * alpha) * std::sqrt(2.0 * mean * (1.0 - mean));
  const double unequal =
      normal_quantile(power) * std::sqrt(rate_1 * (1.0 - rate_1) + rate_2 * (1.0 - rate_2));
  const double ratio = (equal + unequal) / (rate_1 - rate_2);
  return ratio * ratio;
}

double spearman_correlation(std::span<const double> x, std::span<const double> y) {
  AB_CHECK(x.size() == y.size(), x.size(), y.size());
  if (x.size() < 2) return kNaN;
  const std::vector<double> ranks_x = average_ranks(x);
  const std::vector<double> ranks_y = average_ranks(y);
  const double mean = 0.5 * (static_cast<double>(x.size()) + 1.0);
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (ranks_x[i] - mean) * (ranks_y[i] - mean);
    xx += (ranks_x[i] - mean) * (ranks_x[i] - mean);
    yy += (ranks_y[i] - mean) * (ranks_y[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : kNaN;
}

double quantile(std::span<const double> values, double ratio) {
  if (values.empty()) return kNaN;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double place = ratio * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  if (sorted[below] == sorted[above]) return sorted[below];  // both may be infinite
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double contrast_factor(double success_rate_1, double reference_length_1_m, double success_rate_2,
                       double reference_length_2_m) {
  const bool is_defined = success_rate_1 > 0.0 && success_rate_1 < 1.0 && success_rate_2 > 0.0 &&
                          success_rate_2 < 1.0 && reference_length_1_m > 0.0;
  if (!is_defined) return kNaN;
  return reference_length_2_m * math::log(success_rate_1) /
         (reference_length_1_m * math::log(success_rate_2));
}

Interval bootstrap_interval(std::size_t cluster_count,
                            const std::function<double(std::span<const std::size_t>)>& statistic,
                            RandomStream random, std::size_t replicate_count, double confidence) {
  if (cluster_count == 0) return {kNaN, kNaN};
  std::vector<std::size_t> drawn(cluster_count);
  std::vector<double> values;
  for (std::size_t replicate = 0; replicate < replicate_count; ++replicate) {
    for (std::size_t& cluster : drawn) {
      cluster = static_cast<std::size_t>(random.below(cluster_count));
    }
    const double value = statistic(drawn);
    if (value == value) values.push_back(value);
  }
  return {quantile(values, 0.5 - 0.5 * confidence), quantile(values, 0.5 + 0.5 * confidence)};
}

}  // namespace avoidbench
