#include "statistics/ranks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "statistics/distributions.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostExact = 50;  // 2^50 signs are still counted without rounding

/// Twice the ranks, which are whole numbers with ties too.
std::vector<std::size_t> doubled(std::span<const double> ranks) {
  std::vector<std::size_t> whole;
  for (const double rank : ranks) whole.push_back(static_cast<std::size_t>(2.0 * rank));
  return whole;
}

/// z of a sum `distance` from its mean, half a step nearer to it.
double corrected_z(double distance, double variance) {
  if (!(variance > 0.0)) return 0.0;
  const double size = std::max(0.0, std::abs(distance) - 0.5) / std::sqrt(variance);
  return distance < 0.0 ? -size : size;
}

double two_sided_p(double z) { return std::min(1.0, 2.0 * normal_cdf(-std::abs(z))); }

/// Twice the smaller tail of a distribution of counts that `seen` is in, at most 1.
double twice_smaller_tail(std::span<const double> counts, std::size_t seen) {
  double below = 0.0, above = 0.0, all = 0.0;
  for (std::size_t sum = 0; sum < counts.size(); ++sum) {
    all += counts[sum];
    if (sum <= seen) below += counts[sum];
    if (sum >= seen) above += counts[sum];
  }
  return std::min(1.0, 2.0 * std::min(below, above) / all);
}

/// Of all choices of signs, how many have each sum of positive ranks, all doubled.
double exact_signed_rank_p(std::span<const double> ranks, double positive_sum) {
  const std::vector<std::size_t> whole = doubled(ranks);
  std::vector<double> counts(std::accumulate(whole.begin(), whole.end(), std::size_t{0}) + 1, 0.0);
  // One rank after the other: with its sign positive, all sums move up by it.
  counts[0] = 1.0;
  for (const std::size_t rank : whole) {
    // Downwards, so that a rank is taken once only.
    for (std::size_t sum = counts.size() - 1; sum >= rank; --sum) counts[sum] += counts[sum - rank];
  }
  return twice_smaller_tail(counts, static_cast<std::size_t>(2.0 * positive_sum));
}

/// Of all choices of `chosen` of the ranks, how many have each sum, all doubled.
double exact_rank_sum_p(std::span<const double> ranks, std::size_t chosen, double seen_sum) {
  const std::vector<std::size_t> whole = doubled(ranks);
  const std::size_t width = std::accumulate(whole.begin(), whole.end(), std::size_t{0}) + 1;
  std::vector<std::vector<double>> counts(chosen + 1, std::vector<double>(width, 0.0));
  counts[0][0] = 1.0;
  for (const std::size_t rank : whole) {
    // Downwards, so that a rank is taken once only.
    for (std::size_t taken = chosen; taken >= 1; --taken) {
      for (std::size_t sum = rank; sum < width; ++sum) {
        counts[taken][sum] += counts[taken - 1][sum - rank];
      }
    }
  }
  return twice_smaller_tail(counts[chosen], static_cast<std::size_t>(2.0 * seen_sum));
}

}  // namespace

std::vector<double> average_ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    // The mean of the places first + 1 … last + 1.
    const double rank = 1.0 + 0.5 * static_cast<double>(first + last);
    for (std::size_t i = first; i <= last; ++i) ranks[order[i]] = rank;
    first = last + 1;
  }
  return ranks;
}

RankTest wilcoxon_signed_rank(std::span<const double> differences) {
  std::vector<double> sizes;
  std::vector<bool> is_positive;
  for (const double difference : differences) {
    // Wilcoxon's way: what does not differ says nothing about the direction.
    if (difference == 0.0 || difference != difference) continue;
    sizes.push_back(std::abs(difference));
    is_positive.push_back(difference > 0.0);
  }
  const std::vector<double> ranks = average_ranks(sizes);
  double positive_sum = 0.0;
  double variance = 0.0;  // Σ rank²/4 holds with ties too
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (is_positive[i]) positive_sum += ranks[i];
    variance += 0.25 * ranks[i] * ranks[i];
  }
  const auto n = static_cast<double>(sizes.size());
  RankTest test;
  test.count = static_cast<std::int64_t>(sizes.size());
  // Were both signs as likely, the sum's mean would be n (n + 1) / 4.
  test.z = corrected_z(positive_sum - 0.25 * n * (n + 1.0), variance);
  test.is_exact = sizes.size() <= kMostExact;
  test.p = test.is_exact ? exact_signed_rank_p(ranks, positive_sum) : two_sided_p(test.z);
  return test;
}

RankTest mann_whitney(std::span<const double> x, std::span<const double> y) {
  // The values of x first: their ranks are then the first ones.
  std::vector<double> both;
  std::copy_if(x.begin(), x.end(), std::back_inserter(both), [](double v) { return v == v; });
  const std::size_t x_count = both.size();
  std::copy_if(y.begin(), y.end(), std::back_inserter(both), [](double v) { return v == v; });
  RankTest test;
  test.count = static_cast<std::int64_t>(both.size());
  if (x_count == 0 || x_count == both.size()) return test;
  const std::vector<double> ranks = average_ranks(both);
  const auto n = static_cast<double>(both.size());
  const auto n_x = static_cast<double>(x_count);
  double x_sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (i < x_count) x_sum += ranks[i];
    squares += (ranks[i] - 0.5 * (n + 1.0)) * (ranks[i] - 0.5 * (n + 1.0));
  }
  // The variance of a sum of n_x ranks drawn without replacement, which takes ties into account.
  const double variance = n_x * (n - n_x) / (n * (n - 1.0)) * squares;
  test.z = corrected_z(x_sum - 0.5 * n_x * (n + 1.0), variance);
  test.is_exact = both.size() <= kMostExact;
  test.p = test.is_exact ? exact_rank_sum_p(ranks, x_count, x_sum) : two_sided_p(test.z);
  return test;
}

std::vector<double> holm_adjusted(std::span<const double> p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p[i] == p[i]) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.begin(), p.end());
  double greatest = 0.0;
  // The smallest p times the number of tests, the next times one less, and so on.
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto left = static_cast<double>(order.size() - i);
    // Never below that of a smaller p: the order of the tests is kept.
    greatest = std::max(greatest, std::min(1.0, left * p[order[i]]));
    adjusted[order[i]] = greatest;
  }
  return adjusted;
}

}  // namespace avoidbench
