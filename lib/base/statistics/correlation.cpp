#include "statistics/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"
#include "statistics/ranks.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

struct Pairs {
  std::vector<double> x, y;
};

Pairs whole_pairs(std::span<const double> x, std::span<const double> y) {
  AB_CHECK(x.size() == y.size(), x.size(), y.size());
  Pairs pairs;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] != x[i] || y[i] != y[i]) continue;
    pairs.x.push_back(x[i]);
    pairs.y.push_back(y[i]);
  }
  return pairs;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Equal values may differ from their mean by rounding, so they are looked at themselves.
bool is_constant(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); });
}

double correlation_of(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2 || is_constant(x) || is_constant(y)) return kNaN;
  // In two passes: sums of products less products of sums would cancel.
  const double mean_x = mean_of(x);
  const double mean_y = mean_of(y);
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  const double r = xy / (std::sqrt(xx) * std::sqrt(yy));
  // Rounding may take it a bit beyond 1.
  return r == r ? std::clamp(r, -1.0, 1.0) : kNaN;
}

/// By the exponential of -2 |z|, which can't overflow.
double tanh_of(double z) {
  const double e = math::exp(-2.0 * std::abs(z));
  const double size = (1.0 - e) / (1.0 + e);
  return z < 0.0 ? -size : size;
}

}  // namespace

double pearson_correlation(std::span<const double> x, std::span<const double> y) {
  const Pairs pairs = whole_pairs(x, y);
  return correlation_of(pairs.x, pairs.y);
}

double spearman_correlation(std::span<const double> x, std::span<const double> y) {
  const Pairs pairs = whole_pairs(x, y);
  return correlation_of(average_ranks(pairs.x), average_ranks(pairs.y));
}

double kendall_correlation(std::span<const double> x, std::span<const double> y) {
  const Pairs pairs = whole_pairs(x, y);
  const auto sign = [](double difference) { return (difference > 0.0) - (difference < 0.0); };
  int agreement = 0, different_x = 0, different_y = 0;
  for (std::size_t i = 0; i < pairs.x.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const int of_x = sign(pairs.x[i] - pairs.x[k]), of_y = sign(pairs.y[i] - pairs.y[k]);
      agreement += of_x * of_y;
      different_x += of_x * of_x;
      different_y += of_y * of_y;
    }
  }
  if (different_x == 0 || different_y == 0) return kNaN;
  return agreement / std::sqrt(static_cast<double>(different_x) * different_y);
}

Interval correlation_interval(double r, std::size_t count, bool is_spearman, double confidence) {
  if (count < 4 || !(std::abs(r) < 1.0)) return {kNaN, kNaN};
  // Fisher's z = artanh r, about normal.
  const double centre = 0.5 * math::log((1.0 + r) / (1.0 - r));
  const double variance =
      // Bonett and Wright (2000): ranks are a little less certain than values.
      (is_spearman ? 1.0 + 0.5 * r * r : 1.0) / (static_cast<double>(count) - 3.0);
  const double half = normal_quantile(0.5 + 0.5 * confidence) * std::sqrt(variance);
  return {tanh_of(centre - half), tanh_of(centre + half)};
}

}  // namespace avoidbench
