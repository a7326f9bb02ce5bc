#include "statistics/bootstrap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "base/math.hpp"
#include "base/normal_quantile.hpp"
#include "statistics/distributions.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

using Statistic = std::function<double(std::span<const std::size_t>)>;

/// Of the draws, this many must lie beyond an end: with fewer it is the place of a handful of them.
constexpr double kLeastBeyond = 10.0;
/// Draws at most: where more would be needed, what is beyond the end is a guess.
constexpr std::size_t kMostReplicates = 200'000;

/// Appends the statistic of `count` further draws of as many clusters as there are, with
/// replacement.
void add_replicates(std::size_t cluster_count, const Statistic& statistic, std::size_t count,
                    RandomStream& random, std::vector<double>& values) {
  std::vector<std::size_t> drawn(cluster_count);
  for (std::size_t replicate = 0; replicate < count; ++replicate) {
    for (std::size_t& cluster : drawn) {
      cluster = static_cast<std::size_t>(random.below(cluster_count));
    }
    const double value = statistic(drawn);
    // A draw may have no value, as a contrast factor with a rate of 1: the others stand for all.
    if (value == value) values.push_back(value);
  }
}

/// How far the statistic's median is from its value on all clusters, in standard deviations; draws
/// that equal it count half. Nothing where all draws are on one side.
std::optional<double> bias_of(std::span<const double> values, double estimate) {
  if (estimate != estimate) return std::nullopt;
  double below = 0.0;
  for (const double value : values) below += value < estimate ? 1.0 : value == estimate ? 0.5 : 0.0;
  const double ratio = below / static_cast<double>(values.size());
  // The normal quantile would be infinite: percentiles without correction then.
  if (ratio <= 0.0 || ratio >= 1.0) return std::nullopt;
  return normal_quantile(ratio);
}

/// Σ d³ / (6 (Σ d²)^1.5) of the jackknife's deviations d = mean - value.
std::optional<double> acceleration_of(std::size_t cluster_count, const Statistic& statistic) {
  std::vector<std::size_t> others(cluster_count - 1);
  std::vector<double> values;
  for (std::size_t left_out = 0; left_out < cluster_count; ++left_out) {
    std::iota(others.begin(), others.end(), std::size_t{0});
    // All but one: numbers from the one left out on move up by one.
    for (std::size_t i = left_out; i < others.size(); ++i) others[i] = i + 1;
    values.push_back(statistic(others));
  }
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(cluster_count);
  double squares = 0.0, cubes = 0.0;
  for (const double value : values) {
    const double deviation = mean - value;
    squares += deviation * deviation;
    cubes += deviation * deviation * deviation;
  }
  const double acceleration = cubes / (6.0 * squares * std::sqrt(squares));
  // The statistic is the same whichever cluster is left out.
  if (!std::isfinite(acceleration)) return std::nullopt;
  return acceleration;
}

/// The percentile of the draws, as a normal quantile, that stands for z: bias b and acceleration a
/// move it to b + (b + z) / (1 − a (b + z)).
double corrected(double z, std::optional<double> bias, std::optional<double> acceleration) {
  if (!bias || !acceleration) return z;
  const double shifted = *bias + z;
  const double shrink = 1.0 - *acceleration * shifted;
  // At the pole the end is beyond all draws.
  if (shrink <= 0.0) return std::copysign(std::numeric_limits<double>::infinity(), shifted);
  return *bias + shifted / shrink;
}

/// How much of the draws lies beyond a percentile, on its nearer side.
double share_beyond(double z) { return normal_cdf(-std::abs(z)); }

/// Whether draws can say where it is. No percentile is rarer than the rarest draw, that of one
/// cluster n times, 1 / n^n; a rarer one would be the greatest cluster whatever the others say.
bool is_within_reach(double z, std::size_t cluster_count) {
  const auto n = static_cast<double>(cluster_count);
  const double rarest = math::exp(-n * math::log(n));
  return share_beyond(z) >= std::max(rarest, kLeastBeyond / static_cast<double>(kMostReplicates));
}

}  // namespace

/// Linear between the two nearest values (type 7 of Hyndman and Fan, as NumPy and R).
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

/// AvoidBench, eq. (10): flights fail like a Poisson process along the way, at −log(rate) / length
/// per metre.
double contrast_factor(double success_rate_1, double reference_length_1_m, double success_rate_2,
                       double reference_length_2_m) {
  const bool is_defined = success_rate_1 > 0.0 && success_rate_1 < 1.0 && success_rate_2 > 0.0 &&
                          success_rate_2 < 1.0 && reference_length_1_m > 0.0;
  if (!is_defined) return kNaN;
  return reference_length_2_m * math::log(success_rate_1) /
         (reference_length_1_m * math::log(success_rate_2));
}

Interval bca_interval(std::size_t cluster_count, const Statistic& statistic, RandomStream random,
                      std::size_t replicate_count, double confidence) {
  if (cluster_count < 2) return {kNaN, kNaN};
  std::vector<double> values;
  add_replicates(cluster_count, statistic, replicate_count, random, values);
  if (values.empty()) return {kNaN, kNaN};
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (*least == *greatest) return {*least, *greatest};

  std::vector<std::size_t> every(cluster_count);
  std::iota(every.begin(), every.end(), std::size_t{0});
  const double estimate = statistic(every);
  const std::optional<double> acceleration = acceleration_of(cluster_count, statistic);
  const auto n = static_cast<double>(cluster_count);
  // Percentiles of few clusters are too narrow: the bootstrap's variance lacks n / (n - 1), and the
  // normal has thinner tails than Student's t. On synthetic sweeps of 15 maps the interval then
  // covers 94 to 95 % instead of 91 to 93.
  const double widened =
      std::sqrt(n / (n - 1.0)) * student_t_quantile(0.5 + 0.5 * confidence, n - 1.0);
  std::array<double, 2> ends{};  // percentiles, as normal quantiles
  for (std::size_t drawn = replicate_count;;) {
    const std::optional<double> bias = bias_of(values, estimate);
    double wanted = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      ends[i] = corrected(i == 0 ? -widened : widened, bias, acceleration);
      if (!is_within_reach(ends[i], cluster_count)) continue;
      wanted = std::max(wanted, std::ceil(kLeastBeyond / share_beyond(ends[i])));
    }
    const auto enough = static_cast<std::size_t>(wanted);
    if (enough <= drawn) break;
    // At least as many again, since the bias of more draws moves the percentile.
    const std::size_t more = std::min(std::max(enough, 2 * drawn), kMostReplicates) - drawn;
    add_replicates(cluster_count, statistic, more, random, values);
    drawn += more;
  }
  const auto end = [&](double z) {
    return is_within_reach(z, cluster_count) ? quantile(values, normal_cdf(z)) : kNaN;
  };
  return {end(ends[0]), end(ends[1])};
}

}  // namespace avoidbench
