#include "statistics/sample_size.hpp"

#include "base/input_error.hpp"
#include "base/random.hpp"
#include "reference.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

TEST(SampleSize, TrialsNeeded) {
  EXPECT_EQ(std::round(two_rates_trials(0.90, 0.80)), 199);
  EXPECT_EQ(std::round(two_rates_trials(0.60, 0.50)), 387);
  EXPECT_EQ(std::ceil(hoeffding_trials(0.05, 0.99)), 1060);
}

TEST(SampleSize, FisherPowerLikeAllOutcomes) {
  for (const auto& row : reference("power")) {
    const std::vector<double> rates = numbers(row.at("rates"));
    EXPECT_NEAR(two_rates_power_exact(rates[0], rates[1], row.at("trials")),
                row.at("power").get<double>(), 1e-10);
  }
  EXPECT_EQ(two_rates_power_exact(0.9, 0.2, 0), 0.0);
  EXPECT_NEAR(two_rates_power_exact(1.0, 0.0, 4), 1.0, 1e-12);  // p = 2/70
  EXPECT_NEAR(two_rates_power_exact(1.0, 0.0, 3), 0.0, 1e-12);  // p = 2/20
}

TEST(SampleSize, ExactTrialsAreTheFirstFromWhichOnThePowerHolds) {
  for (const auto& [one, two] : std::vector<std::pair<double, double>>{
           {0.9, 0.8}, {0.9, 0.2}, {0.6, 0.5}, {1.0, 0.9}, {0.05, 0.0}}) {
    const std::int64_t trials = two_rates_trials_exact(one, two);
    EXPECT_LT(two_rates_power_exact(one, two, trials - 1), 0.8);
    for (std::int64_t n = trials; n < trials + 30; ++n) {
      EXPECT_GE(two_rates_power_exact(one, two, n), 0.8) << n;
    }
    EXPECT_EQ(trials, two_rates_trials_exact(two, one));
  }
  EXPECT_EQ(two_rates_trials_exact(1.0, 0.0), 4);
  EXPECT_THROW(two_rates_trials_exact(0.5, 0.5), InputError);
  EXPECT_THROW(two_rates_trials_exact(1.5, 0.5), InputError);
  EXPECT_THROW(two_rates_trials_exact(0.7, 0.5, 1.0), InputError);
  EXPECT_THROW(two_rates_trials_exact(0.7, 0.5, 0.8, 1.0), InputError);
}

// Casagrande, Pike and Smith (1978) and its kin give 219 for 0.9 against 0.8.
TEST(SampleSize, ExactIsNearTheContinuityCorrection) {
  EXPECT_NEAR(static_cast<double>(two_rates_trials_exact(0.9, 0.8)), 219, 8);
  EXPECT_NEAR(static_cast<double>(two_rates_trials_exact(0.6, 0.5)), 407, 8);
  EXPECT_GT(two_rates_trials_exact(0.505, 0.5), 100000);  // by the formula
}

TEST(SampleSize, PairedMissionsAreFewerWherePlannersAgree) {
  const std::int64_t agreeing = paired_rates_trials(0.8, 0.1, 0.1, 0.8, 0.05);
  const std::int64_t differing = paired_rates_trials(0.8, 0.1, 0.26, 0.8, 0.05);
  EXPECT_LT(agreeing, differing);
  // All differences are for the second: at least six must differ, P(Bin(n, 0.1) >= 6) >= 0.8.
  EXPECT_EQ(agreeing, 78);
  // Connor (1987): (1.96 sqrt(0.26) + 0.8416 sqrt(0.25))² / 0.01 = 201.4.
  EXPECT_NEAR(static_cast<double>(differing), 201.4, 20.0);
  EXPECT_EQ(paired_rates_trials(0.9, -0.1, 0.26, 0.8, 0.05), differing);
  EXPECT_THROW(paired_rates_trials(0.8, 0.1, 0.05, 0.8, 0.05), InputError);  // change > discordance
  EXPECT_THROW(paired_rates_trials(0.95, 0.1, 0.2, 0.8, 0.05), InputError);
  for (const double level : {0.0, 1.0, -0.1, 1.5}) {
    EXPECT_THROW(paired_rates_trials(0.8, 0.1, 0.2, level, 0.05), InputError) << level;
    EXPECT_THROW(paired_rates_trials(0.8, 0.1, 0.2, 0.8, level), InputError) << level;
  }
  EXPECT_THROW(paired_rates_trials(0.8, 0.0, 0.2, 0.8, 0.05), InputError);
}

TEST(SampleSize, PairedPowerBySimulation) {
  const std::int64_t missions = paired_rates_trials(0.7, 0.1, 0.3, 0.8, 0.05);
  RandomStream random(11);
  int found = 0;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    std::int64_t only_first = 0, only_second = 0;
    for (std::int64_t mission = 0; mission < missions; ++mission) {
      const double u = random.uniform();
      only_first += u < 0.1 ? 1 : 0;
      only_second += u >= 0.1 && u < 0.3 ? 1 : 0;
    }
    found += mcnemar_exact_p(only_first, only_second) < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(found / static_cast<double>(kRuns), 0.8, 0.03);
}

TEST(SampleSize, WilsonWidthIsReachedAndNotBefore) {
  for (const double rate : {0.0, 0.5, 0.9, 1.0}) {
    for (const double half_width : {0.2, 0.05, 0.01}) {
      const std::int64_t trials = wilson_width_trials(rate, half_width);
      const auto half = [&](std::int64_t n) {
        const double z = 1.959963984540054;
        const auto m = static_cast<double>(n);
        return z / (1.0 + z * z / m) * std::sqrt(rate * (1.0 - rate) / m + z * z / (4.0 * m * m));
      };
      EXPECT_LE(half(trials), half_width);
      EXPECT_GT(half(trials - 1), half_width);
    }
  }
  const Interval interval = wilson_interval(126, 140);  // 0.9
  EXPECT_NEAR(0.5 * (interval.upper - interval.lower), 0.05, 5e-4);
  EXPECT_NEAR(static_cast<double>(wilson_width_trials(0.9, 0.05)), 140, 1.5);
}

}  // namespace
}  // namespace avoidbench
