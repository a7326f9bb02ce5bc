#include "statistics/rates.hpp"

#include "reference.hpp"

namespace avoidbench {
namespace {

TEST(Rates, WilsonIntervalsWorkedByHand) {
  EXPECT_NEAR(wilson_interval(10, 10).lower, 0.722, 5e-4);
  EXPECT_EQ(wilson_interval(10, 10).upper, 1.0);
  EXPECT_NEAR(wilson_interval(6, 10).lower, 0.313, 5e-4);
  EXPECT_NEAR(wilson_interval(6, 10).upper, 0.832, 5e-4);
  EXPECT_NEAR(wilson_interval(2, 10).lower, 0.057, 5e-4);
  EXPECT_NEAR(wilson_interval(2, 10).upper, 0.510, 5e-4);
  EXPECT_EQ(wilson_interval(0, 10).lower, 0.0);
  EXPECT_TRUE(std::isnan(wilson_interval(0, 0).lower));
}

TEST(Rates, WilsonIntervalMirrors) {
  for (int k = 0; k <= 17; ++k) {
    const Interval a = wilson_interval(k, 17);
    const Interval b = wilson_interval(17 - k, 17);
    EXPECT_NEAR(a.lower, 1.0 - b.upper, 1e-15);
    EXPECT_LE(a.lower, k / 17.0);
    EXPECT_GE(a.upper, k / 17.0);
  }
}

TEST(Rates, FisherWorkedByHand) {
  EXPECT_NEAR(fisher_exact_p(6, 10, 2, 10), 0.170, 5e-4);
  EXPECT_NEAR(fisher_exact_p(10, 10, 6, 10), 0.087, 5e-4);
  EXPECT_NEAR(fisher_exact_p(9, 10, 2, 10), 0.0055, 5e-5);
  EXPECT_NEAR(fisher_exact_p(3, 4, 1, 4), 34.0 / 70.0, 1e-12);  // the lady tasting tea
  EXPECT_NEAR(fisher_exact_p(5, 10, 5, 10), 1.0, 1e-12);
  EXPECT_EQ(fisher_exact_p(0, 0, 5, 10), 1.0);
  EXPECT_NEAR(fisher_exact_p(7, 12, 3, 20), fisher_exact_p(3, 20, 7, 12), 1e-14);
}

TEST(Rates, PoissonIntervalsOfGarwood) {
  EXPECT_EQ(poisson_interval(0).lower, 0.0);
  EXPECT_NEAR(poisson_interval(0).upper, -std::log(0.025), 1e-12);
  EXPECT_NEAR(poisson_interval(1).lower, -std::log(0.975), 1e-12);
  EXPECT_NEAR(poisson_interval(10).lower, 4.7954, 5e-5);
  EXPECT_NEAR(poisson_interval(10).upper, 18.3904, 5e-5);
  EXPECT_NEAR(poisson_interval(100).lower, 81.3640, 5e-5);
  EXPECT_NEAR(poisson_interval(100).upper, 121.6271, 5e-4);
  for (const std::int64_t count : {3, 40, 2000}) {
    // The ends are the means of which a count as low, or as high, has 2.5 %.
    const auto at_most = [](double mean, std::int64_t k) {
      double sum = 0.0, log_term = -mean;
      for (std::int64_t i = 0; i <= k; ++i) {
        sum += std::exp(log_term);
        log_term += std::log(mean) - std::log(static_cast<double>(i + 1));
      }
      return sum;
    };
    EXPECT_NEAR(at_most(poisson_interval(count).upper, count), 0.025, 1e-9);
    EXPECT_NEAR(1.0 - at_most(poisson_interval(count).lower, count - 1), 0.025, 1e-9);
  }
}

TEST(Rates, JeffreysRateIsNeverSure) {
  EXPECT_EQ(jeffreys_rate(0, 9), 0.05);
  EXPECT_EQ(jeffreys_rate(9, 9), 0.95);
}

TEST(Rates, IntervalsLikeScipy) {
  for (const auto& row : reference("intervals")) {
    const std::int64_t successes = row.at("successes");
    const std::int64_t trials = row.at("trials");
    const double confidence = row.at("confidence");
    const auto expect = [&](const Interval& interval, const char* name) {
      SCOPED_TRACE(std::string(name) + " " + row.dump());
      const std::vector<double> ends = numbers(row.at(name));
      expect_close(interval.lower, ends[0], 1e-10);
      expect_close(interval.upper, ends[1], 1e-10);
    };
    expect(wilson_interval(successes, trials, confidence), "wilson");
    expect(clopper_pearson_interval(successes, trials, confidence), "exact");
    expect(jeffreys_interval(successes, trials, confidence), "jeffreys");
  }
  EXPECT_TRUE(std::isnan(clopper_pearson_interval(0, 0).lower));
  EXPECT_TRUE(std::isnan(jeffreys_interval(0, 0).upper));
}

TEST(Rates, ClopperPearsonAtTheEndsInClosedForm) {
  // Nothing of n: (1 - upper)^n = 0.025.
  for (const int n : {1, 3, 10, 300}) {
    EXPECT_NEAR(clopper_pearson_interval(0, n).upper, 1.0 - std::pow(0.025, 1.0 / n), 1e-12);
    EXPECT_NEAR(clopper_pearson_interval(n, n).lower, std::pow(0.025, 1.0 / n), 1e-12);
  }
}

/// P that the interval holds `rate`, over all outcomes of `trials`.
template <class IntervalOf>
double coverage(double rate, int trials, IntervalOf interval_of) {
  double covered = 0.0;
  for (int k = 0; k <= trials; ++k) {
    const Interval interval = interval_of(k, trials);
    if (interval.lower > rate || interval.upper < rate) continue;
    covered +=
        std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) - std::lgamma(trials - k + 1.0) +
                 k * std::log(rate) + (trials - k) * std::log(1.0 - rate));
  }
  return covered;
}

TEST(Rates, CoverageByAllOutcomes) {
  double wilson_sum = 0.0;
  int rates = 0;
  for (double rate = 0.02; rate < 0.985; rate += 0.02, ++rates) {
    const double exact =
        coverage(rate, 30, [](int k, int n) { return clopper_pearson_interval(k, n); });
    EXPECT_GE(exact, 0.95) << rate;  // never less, which is its promise
    wilson_sum += coverage(rate, 30, [](int k, int n) { return wilson_interval(k, n); });
  }
  EXPECT_NEAR(wilson_sum / rates, 0.95, 0.01);  // as promised on average
}

TEST(Rates, FisherLikeScipy) {
  for (const auto& row : reference("fisher")) {
    const std::vector<std::int64_t> c = counts(row.at("counts"));
    expect_close(fisher_exact_p(c[0], c[1], c[2], c[3]), row.at("p"), 1e-9);
  }
}

TEST(Rates, McNemarLikeScipy) {
  for (const auto& row : reference("mcnemar")) {
    const std::int64_t only_first = row.at("only_first");
    const std::int64_t only_second = row.at("only_second");
    expect_close(mcnemar_exact_p(only_first, only_second), row.at("p"), 1e-10);
    EXPECT_EQ(mcnemar_exact_p(only_first, only_second), mcnemar_exact_p(only_second, only_first));
  }
  EXPECT_EQ(mcnemar_exact_p(0, 0), 1.0);
  EXPECT_NEAR(mcnemar_exact_p(0, 6), 2.0 / 64.0, 1e-15);
}

TEST(Rates, ClusteredIntervalIsThatOfTheMapsWhereTheyDecide) {
  // Maps on which all trials succeed or all fail: each map is one trial. The design effect is then
  // 10 · 20 / 19, and the interval Wilson's at 19 trials with t.
  std::vector<std::int64_t> successes(20, 10), trials(20, 10);
  for (std::size_t i = 0; i < 5; ++i) successes[i] = 0;
  const double t = 2.0930240544083;  // t(0.975; 19), of tables
  const double scale = 1.0 / (1.0 + t * t / 19.0);
  const double half = scale * t * std::sqrt(0.75 * 0.25 / 19.0 + t * t / (4.0 * 19.0 * 19.0));
  const double centre = scale * (0.75 + t * t / 38.0);
  const Interval interval = clustered_wilson_interval(successes, trials);
  EXPECT_NEAR(interval.lower, centre - half, 1e-10);
  EXPECT_NEAR(interval.upper, centre + half, 1e-10);
}

TEST(Rates, ClusteredIntervalTakesTwoClusters) {
  const std::vector<std::int64_t> successes{3, 5, 0}, trials{10, 10, 0};
  const std::span<const std::int64_t> s(successes), n(trials);
  EXPECT_TRUE(std::isnan(clustered_wilson_interval(s.first(1), n.first(1)).lower));
  const Interval two = clustered_wilson_interval(s.first(2), n.first(2));
  EXPECT_GT(two.lower, 0.0);
  EXPECT_LT(two.upper, 1.0);
  // A cluster without trials is none.
  EXPECT_EQ(clustered_wilson_interval(s, n).lower, two.lower);
  EXPECT_TRUE(std::isnan(clustered_wilson_interval(s.last(2), n.last(2)).upper));
}

TEST(Rates, ClusteredIntervalIsNeverNarrowerThanWilsons) {
  const std::vector<std::int64_t> trials{10, 10, 10, 0, 5, 10};
  for (const std::vector<std::int64_t>& successes : {std::vector<std::int64_t>{5, 5, 5, 0, 2, 5},
                                                     {10, 10, 10, 0, 5, 10},
                                                     {0, 0, 0, 0, 0, 0},
                                                     {10, 0, 10, 0, 0, 10},
                                                     {9, 8, 10, 0, 5, 9}}) {
    std::int64_t all = 0;
    for (const std::int64_t count : successes) all += count;
    const Interval wilson = wilson_interval(all, 45);
    const Interval clustered = clustered_wilson_interval(successes, trials);
    EXPECT_LE(clustered.lower, wilson.lower);
    EXPECT_GE(clustered.upper, wilson.upper);
    EXPECT_GE(clustered.lower, 0.0);
    EXPECT_LE(clustered.upper, 1.0);
  }
  EXPECT_TRUE(std::isnan(
      clustered_wilson_interval(std::vector<std::int64_t>{3, 0}, std::vector<std::int64_t>{10, 0})
          .lower));
}

}  // namespace
}  // namespace avoidbench
