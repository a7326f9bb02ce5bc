#include "statistics/logistic.hpp"

#include "reference.hpp"

namespace avoidbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Counts = std::vector<std::int64_t>;

TEST(Logistic, LikeScipysMaximumOfTheLikelihood) {
  for (const auto& row : reference("logistic")) {
    SCOPED_TRACE(row.dump());
    const LogisticFit fit =
        logistic_fit(numbers(row.at("x")), counts(row.at("successes")), counts(row.at("trials")));
    EXPECT_TRUE(fit.is_converged);
    EXPECT_FALSE(fit.is_separated);
    expect_close(fit.intercept, row.at("intercept"), 1e-8);
    EXPECT_NEAR(fit.slope, row.at("slope").get<double>(), 1e-8);
    const std::vector<double> covariance = numbers(row.at("covariance"));
    for (std::size_t i = 0; i < 3; ++i) expect_close(fit.covariance[i], covariance[i], 1e-7);
    const Interval interval = logistic_midpoint_interval(fit);
    if (row.at("midpoint_interval").is_null()) {
      EXPECT_EQ(interval.lower, -kInfinity);
      EXPECT_EQ(interval.upper, kInfinity);
    } else {
      const std::vector<double> ends = numbers(row.at("midpoint_interval"));
      expect_close(interval.lower, ends[0], 1e-8);
      expect_close(interval.upper, ends[1], 1e-8);
      EXPECT_LT(interval.lower, fit.midpoint());
      EXPECT_GT(interval.upper, fit.midpoint());
    }
  }
}

// Erosion of the Space Shuttle's O-rings over temperature in °F (Dalal, Fowlkes and Hoadley 1989);
// coefficients and standard errors of many textbooks: 15.0429 (7.3786), -0.2322 (0.1082).
TEST(Logistic, ChallengerAsPublished) {
  const std::vector<double> fahrenheit{53, 57, 58, 63, 66, 67, 68, 69,
                                       70, 72, 73, 75, 76, 78, 79, 81};
  const Counts trials{1, 1, 1, 1, 1, 3, 1, 1, 4, 1, 1, 2, 2, 1, 1, 1};
  const Counts eroded{1, 1, 1, 1, 0, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0};
  const LogisticFit fit = logistic_fit(fahrenheit, eroded, trials);
  EXPECT_NEAR(fit.intercept, 15.0429, 5e-5);
  EXPECT_NEAR(fit.slope, -0.2322, 5e-5);
  EXPECT_NEAR(std::sqrt(fit.covariance[0]), 7.3786, 5e-4);
  EXPECT_NEAR(std::sqrt(fit.covariance[2]), 0.1082, 5e-5);
}

TEST(Logistic, TwoPointsGoThroughTheirRates) {
  const LogisticFit fit = logistic_fit(std::vector<double>{0, 2}, Counts{9, 2}, Counts{10, 10});
  EXPECT_NEAR(fit.intercept, std::log(9.0), 1e-12);
  EXPECT_NEAR(fit.intercept + 2.0 * fit.slope, std::log(0.25), 1e-12);
  EXPECT_NEAR(fit.midpoint(), 2.0 * std::log(9.0) / std::log(36.0), 1e-12);
  EXPECT_NEAR(fit.covariance[0], 1.0 / 0.9, 1e-10);  // 1 / (n p (1 - p)) of the first
}

TEST(Logistic, TellsSeparation) {
  const std::vector<double> x{1, 2, 3, 4};
  const Counts trials{5, 5, 5, 5};
  for (const Counts& successes : {Counts{5, 5, 0, 0},
                                  {0, 0, 5, 5},  // complete
                                  Counts{5, 3, 0, 0},
                                  {0, 0, 0, 2},  // quasi: both kinds at one place only
                                  Counts{5, 5, 5, 5},
                                  {0, 0, 0, 0}}) {  // all equal
    const LogisticFit fit = logistic_fit(x, successes, trials);
    EXPECT_TRUE(fit.is_separated);
    EXPECT_FALSE(fit.is_converged);
    EXPECT_TRUE(std::isnan(fit.slope));
    EXPECT_TRUE(std::isnan(fit.midpoint()));
    EXPECT_TRUE(std::isnan(logistic_midpoint_interval(fit).lower));
  }
  EXPECT_FALSE(logistic_fit(x, Counts{5, 4, 1, 0}, trials).is_separated);
}

TEST(Logistic, WithoutSpreadOrTrialsThereIsNoCurve) {
  const LogisticFit one_place = logistic_fit(std::vector<double>{2, 2}, Counts{1, 2}, Counts{3, 3});
  EXPECT_FALSE(one_place.is_converged);
  EXPECT_FALSE(one_place.is_separated);
  EXPECT_FALSE(logistic_fit({}, {}, {}).is_converged);
  const LogisticFit with_gaps = logistic_fit(std::vector<double>{0, 1, std::nan(""), 2},
                                             Counts{9, 0, 3, 2}, Counts{10, 0, 5, 10});
  EXPECT_NEAR(with_gaps.intercept, std::log(9.0), 1e-12);
}

}  // namespace
}  // namespace avoidbench
