#include "report/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"

namespace avoidbench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Σ coefficients[i] x^i
double polynomial(const std::array<double, 8>& coefficients, double x) {
  double value = 0.0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * x + *c;
  return value;
}

// Coefficients of AS 241: numerators and denominators of the middle, the tails and the far tails.
constexpr std::array<double, 8> kMiddleTop = {3.3871328727963666080e0, 1.3314166789178437745e2,
                                              1.9715909503065514427e3, 1.3731693765509461125e4,
                                              4.5921953931549871457e4, 6.7265770927008700853e4,
                                              3.3430575583588128105e4, 2.5090809287301226727e3};
constexpr std::array<double, 8> kMiddleBottom = {1.0,
                                                 4.2313330701600911252e1,
                                                 6.8718700749205790830e2,
                                                 5.3941960214247511077e3,
                                                 2.1213794301586595867e4,
                                                 3.9307895800092710610e4,
                                                 2.8729085735721942674e4,
                                                 5.2264952788528545610e3};
constexpr std::array<double, 8> kTailTop = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                            5.76949722146069140550e0,  3.64784832476320460504e0,
                                            1.27045825245236838258e0,  2.41780725177450611770e-1,
                                            2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr std::array<double, 8> kTailBottom = {1.0,
                                               2.05319162663775882187e0,
                                               1.67638483018380384940e0,
                                               6.89767334985100004550e-1,
                                               1.48103976427480074590e-1,
                                               1.51986665636164571966e-2,
                                               5.47593808499534494600e-4,
                                               1.05075007164441684324e-9};
constexpr std::array<double, 8> kFarTop = {6.65790464350110377720e0,  5.46378491116411436990e0,
                                           1.78482653991729133580e0,  2.96560571828504891230e-1,
                                           2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                           2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr std::array<double, 8> kFarBottom = {1.0,
                                              5.99832206555887937690e-1,
                                              1.36929880922735805310e-1,
                                              1.48753612908506148525e-2,
                                              7.86869131145613259100e-4,
                                              1.84631831751005468180e-5,
                                              1.42151175831644588870e-7,
                                              2.04426310338993978564e-15};

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

double normal_quantile(double p) {
  AB_CHECK(p > 0.0 && p < 1.0, p);
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(kMiddleTop, r) / polynomial(kMiddleBottom, r);
  }
  const double r = std::sqrt(-math::log(q < 0.0 ? p : 1.0 - p));
  const double size = r <= 5.0 ? polynomial(kTailTop, r - 1.6) / polynomial(kTailBottom, r - 1.6)
                               : polynomial(kFarTop, r - 5.0) / polynomial(kFarBottom, r - 5.0);
  return q < 0.0 ? -size : size;
}

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
