#include "statistics/distributions.hpp"

#include "reference.hpp"

namespace avoidbench {
namespace {

TEST(Distributions, NormalLikeScipy) {
  for (const auto& row : reference("normal_cdf")) {
    expect_close(normal_cdf(row.at("z")), row.at("p"), 1e-13);
  }
  EXPECT_EQ(normal_cdf(0.0), 0.5);
  EXPECT_TRUE(std::isnan(normal_cdf(std::nan(""))));
}

TEST(Distributions, NormalIsContinuousWhereItsFormulaChanges) {
  for (const double z : {-2.0, 2.0}) {
    EXPECT_NEAR(normal_cdf(std::nextafter(z, 0.0)), normal_cdf(z), 1e-15);
  }
}

TEST(Distributions, StudentsTLikeScipy) {
  for (const auto& row : reference("student_t_quantile")) {
    expect_close(student_t_quantile(row.at("p"), row.at("freedom")), row.at("t"));
  }
  EXPECT_EQ(student_t_quantile(0.5, 3.0), 0.0);
  // One degree of freedom is Cauchy's: tan(π/4) = 1 at 3/4.
  EXPECT_NEAR(student_t_quantile(0.75, 1.0), 1.0, 1e-12);
}

TEST(Distributions, BetaLikeScipyAndBack) {
  for (const auto& row : reference("beta_cdf")) {
    const double a = row.at("a");
    const double b = row.at("b");
    const double p = row.at("p");
    expect_close(beta_cdf(row.at("x"), a, b), p);
    expect_close(beta_quantile(p, a, b), row.at("x"));
    EXPECT_NEAR(1.0 - beta_cdf(1.0 - row.at("x").get<double>(), b, a), p, 1e-12);
  }
  EXPECT_EQ(beta_cdf(0.0, 2.0, 3.0), 0.0);
  EXPECT_EQ(beta_cdf(1.0, 2.0, 3.0), 1.0);
}

TEST(Distributions, GammaAndBinomial) {
  for (const auto& row : reference("log_gamma")) {
    EXPECT_NEAR(log_gamma(row.at("x")), row.at("value").get<double>(),
                1e-14 * std::max(1.0, std::abs(row.at("value").get<double>())));
  }
  EXPECT_NEAR(log_choose(10.0, 3.0), std::log(120.0), 1e-13);
  EXPECT_NEAR(binomial_cdf(1.0, 4.0, 0.5), 5.0 / 16.0, 1e-14);
  EXPECT_EQ(binomial_cdf(-1.0, 4.0, 0.5), 0.0);
  EXPECT_EQ(binomial_cdf(4.0, 4.0, 0.5), 1.0);
}

}  // namespace
}  // namespace avoidbench
