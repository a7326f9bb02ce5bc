#include "statistics/bootstrap.hpp"

#include <map>
#include <numeric>

#include "base/normal_quantile.hpp"
#include "reference.hpp"
#include "statistics/distributions.hpp"

namespace avoidbench {
namespace {

/// The mean of `values` at the indices.
auto mean_of(const std::vector<double>& values) {
  return [&values](std::span<const std::size_t> drawn) {
    double total = 0.0;
    for (const std::size_t i : drawn) total += values[i];
    return total / static_cast<double>(drawn.size());
  };
}

TEST(Bootstrap, ContrastFactorIsTheRatioOfFailuresAMetre) {
  // Failures of intensity λ a metre: SR = exp(-λ d).
  const double one = std::exp(-0.02 * 30.0);
  const double two = std::exp(-0.01 * 50.0);
  EXPECT_NEAR(contrast_factor(one, 30.0, two, 50.0), 2.0, 1e-12);
  EXPECT_NEAR(contrast_factor(two, 50.0, one, 30.0), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(contrast_factor(1.0, 30.0, 0.5, 30.0)));
  EXPECT_TRUE(std::isnan(contrast_factor(0.5, 30.0, 0.0, 30.0)));
}

TEST(Bootstrap, QuantilesAreLinearBetweenOrderStatistics) {
  const std::vector<double> values{4, 1, 3, 2};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 1.0), 4.0);
  EXPECT_EQ(quantile(values, 0.5), 2.5);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Bootstrap, BootstrapOfAMeanHasItsSpread) {
  std::vector<double> values;
  RandomStream random(5);
  for (int i = 0; i < 400; ++i) values.push_back(random.normal());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / 400.0;
  const Interval interval = bca_interval(values.size(), mean_of(values), stream(1, "test"));
  EXPECT_NEAR(interval.lower, mean - 1.96 / 20.0, 0.015);
  EXPECT_NEAR(interval.upper, mean + 1.96 / 20.0, 0.015);
  const Interval again = bca_interval(values.size(), mean_of(values), stream(1, "test"));
  EXPECT_EQ(interval.lower, again.lower);
  EXPECT_EQ(interval.upper, again.upper);
}

TEST(Bootstrap, IsScipysBcaButForItsWidening) {
  const nlohmann::json row = reference("bootstrap");
  const std::vector<double> values = numbers(row.at("values"));
  // The confidence whose widened quantile is the normal one of 95 %.
  const double n = static_cast<double>(values.size());
  const double t = 1.959963984540054 * std::sqrt((n - 1.0) / n);
  const double outside = beta_cdf((n - 1.0) / (n - 1.0 + t * t), 0.5 * (n - 1.0), 0.5);
  const Interval interval =
      bca_interval(values.size(), mean_of(values), stream(1, "test"), 40000, 1.0 - outside);
  const std::vector<double> ends = numbers(row.at("bca"));
  const double monte_carlo = 0.06 * row.at("standard_deviation").get<double>();
  EXPECT_NEAR(interval.lower, ends[0], monte_carlo);
  EXPECT_NEAR(interval.upper, ends[1], monte_carlo);
  const Interval widened = bca_interval(values.size(), mean_of(values), stream(1, "test"), 40000);
  EXPECT_LT(widened.lower, interval.lower);
  EXPECT_GT(widened.upper, interval.upper);
}

TEST(Bootstrap, FallsBackWhereThereIsNoBiasOrAcceleration) {
  const std::vector<double> constant(12, 3.0);
  const Interval point = bca_interval(12, mean_of(constant), stream(1, "test"));
  EXPECT_EQ(point.lower, 3.0);
  EXPECT_EQ(point.upper, 3.0);

  // A maximum: no draw is above it, so that its upper end is beyond all draws.
  std::vector<double> rising;
  for (int i = 0; i < 12; ++i) rising.push_back(i);
  const Interval maximum = bca_interval(
      12,
      [&](std::span<const std::size_t> drawn) {
        return rising[*std::max_element(drawn.begin(), drawn.end())];
      },
      stream(1, "test"));
  EXPECT_TRUE(std::isnan(maximum.upper));
  EXPECT_LT(maximum.lower, 11.0);

  // Undefined without the last cluster: the percentiles of the draws that have it.
  const Interval sparse = bca_interval(
      12,
      [&](std::span<const std::size_t> drawn) {
        const bool has_last = std::find(drawn.begin(), drawn.end(), 11U) != drawn.end();
        return has_last ? mean_of(rising)(drawn) : std::nan("");
      },
      stream(1, "test"));
  EXPECT_LT(sparse.lower, 5.5);
  EXPECT_GT(sparse.upper, 5.5);

  const auto never = [](std::span<const std::size_t>) { return std::nan(""); };
  EXPECT_TRUE(std::isnan(bca_interval(12, never, stream(1, "test")).lower));
  EXPECT_TRUE(std::isnan(bca_interval(1, mean_of(rising), stream(1, "test")).lower));
  EXPECT_TRUE(std::isnan(bca_interval(0, mean_of(rising), stream(1, "test")).upper));
}

TEST(Bootstrap, DrawsThatEqualTheEstimateCountHalf) {
  // A quarter of the draws are 5 of 10 again: counted on either side alone they were a bias.
  std::vector<double> values(10, 0.0);
  std::fill_n(values.begin(), 5, 1.0);
  const Interval interval = bca_interval(values.size(), mean_of(values), stream(1, "test"), 40000);
  EXPECT_NEAR(interval.lower + interval.upper, 1.0, 1e-6);
  EXPECT_LT(interval.lower, 0.3);
}

/// Every draw of the mean of `values` with its probability, by counting: how often each is drawn is
/// multinomial.
std::map<double, double> all_means(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  std::map<double, double> probabilities;
  const std::function<void(std::size_t, int, double, double)> add =
      [&](std::size_t i, int left, double sum, double log_weight) {
        if (i + 1 == values.size()) {
          const double weight = log_weight - std::lgamma(left + 1.0);
          probabilities[(sum + left * values[i]) / n] += std::exp(weight);
          return;
        }
        for (int k = 0; k <= left; ++k) {
          add(i + 1, left - k, sum + k * values[i], log_weight - std::lgamma(k + 1.0));
        }
      };
  add(0, static_cast<int>(values.size()), 0.0, std::lgamma(n + 1.0) - n * std::log(n));
  return probabilities;
}

/// The upper end of the widened BCa interval, of all draws instead of some.
double exact_upper(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const std::map<double, double> means = all_means(values);
  const double estimate = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double below = 0.0, squares = 0.0, cubes = 0.0;
  for (const auto& [mean, probability] : means) {
    below += mean < estimate ? probability : mean == estimate ? 0.5 * probability : 0.0;
  }
  for (const double value : values) {
    squares += std::pow(value - estimate, 2.0);
    cubes += std::pow(value - estimate, 3.0);
  }
  const double acceleration = cubes / (6.0 * std::pow(squares, 1.5));
  const double widened = std::sqrt(n / (n - 1.0)) * student_t_quantile(0.975, n - 1.0);
  const double shifted = normal_quantile(below) + widened;
  const double level =
      normal_cdf(normal_quantile(below) + shifted / (1.0 - acceleration * shifted));
  double sum = 0.0;
  for (const auto& [mean, probability] : means) {
    sum += probability;
    if (sum >= level) return mean;
  }
  return means.rbegin()->first;
}

TEST(Bootstrap, AnEndFarOutTakesEnoughDraws) {
  // One map in eight that stands apart: one draw in 8,000 is beyond the upper end. The greatest of
  // 2,000 draws, where it would be without more, is about 14.
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 8, 20};
  EXPECT_EQ(exact_upper(values), 15.0);
  double sum = 0.0;
  constexpr int kStreams = 20;
  for (int seed = 0; seed < kStreams; ++seed) {
    sum += bca_interval(8, mean_of(values), stream(static_cast<std::uint64_t>(seed), "t")).upper;
  }
  EXPECT_NEAR(sum / kStreams, 15.0, 0.25);
}

TEST(Bootstrap, AnEndThatNoDrawsTellIsUnknown) {
  const auto interval_of = [](const std::vector<double>& values) {
    return bca_interval(values.size(), mean_of(values), stream(1, "test"));
  };
  // Beyond its upper end there is one draw in three millions, and the rarest, five times the map
  // of 30, is one in 3125.
  const Interval apart = interval_of({1, 2, 3, 4, 30});
  EXPECT_NEAR(apart.lower, 1.6, 0.21);
  EXPECT_TRUE(std::isnan(apart.upper));
  const Interval below = interval_of({-1, -2, -3, -4, -30});
  EXPECT_TRUE(std::isnan(below.lower));
  EXPECT_NEAR(below.upper, -1.6, 0.21);
  // Of five that are even both ends are among the draws: one in 1048 is beyond.
  const Interval even = interval_of({1, 2, 3, 4, 5});
  EXPECT_NEAR(even.lower, 1.2, 0.21);
  EXPECT_NEAR(even.upper, exact_upper({1, 2, 3, 4, 5}), 0.21);
  // Four have none, unless all are alike.
  EXPECT_TRUE(std::isnan(interval_of({1, 2, 3, 4}).lower));
  EXPECT_TRUE(std::isnan(interval_of({1, 2, 3, 4}).upper));
  EXPECT_EQ(interval_of({3, 3, 3}).lower, 3.0);
  EXPECT_EQ(interval_of({3, 3, 3}).upper, 3.0);
}

TEST(Bootstrap, IsSkewedAsItsStatistic) {
  std::vector<double> values;
  RandomStream random(7);
  for (int i = 0; i < 40; ++i) {
    const double normal = random.normal();
    values.push_back(std::exp(normal));
  }
  double mean = 0.0;
  for (const double value : values) mean += value / 40.0;
  const Interval interval = bca_interval(40, mean_of(values), stream(1, "test"));
  EXPECT_GT(interval.upper - mean, 1.2 * (mean - interval.lower));
}

}  // namespace
}  // namespace avoidbench
