#include "statistics/failure_rate.hpp"

#include "base/math.hpp"
#include "reference.hpp"

namespace avoidbench {
namespace {

std::vector<ExposedTrial> trials_of(const nlohmann::json& rows) {
  std::vector<ExposedTrial> trials;
  for (const auto& row : rows) {
    trials.push_back({.map = row[0].get<std::size_t>(),
                      .x = row[1],
                      .exposure = row[2],
                      .has_failed = row[3] == 1});
  }
  return trials;
}

struct Moments {
  double mean = 0.0, deviation = 0.0;
};

Moments moments(const FailureRateFit& fit, double FailureRateDraw::*part) {
  Moments found;
  const auto count = static_cast<double>(fit.draws.size());
  for (const auto& draw : fit.draws) found.mean += draw.*part / count;
  for (const auto& draw : fit.draws) {
    found.deviation += (draw.*part - found.mean) * (draw.*part - found.mean) / count;
  }
  found.deviation = std::sqrt(found.deviation);
  return found;
}

// 2,000 draws know a mean to a twentieth of its deviation or so.
TEST(FailureRate, LikeSumsOverAGrid) {
  for (const auto& row : reference("failure_rate")) {
    SCOPED_TRACE(row.at("mean").dump());
    const FailureRateFit fit = fit_failure_rate(trials_of(row.at("trials")));
    EXPECT_EQ(fit.draws.size(), kFailureDraws);
    EXPECT_GT(fit.effective_share, 0.2);
    const auto expect_like = [&](const char* name, double FailureRateDraw::*part) {
      const Moments found = moments(fit, part);
      const double deviation = row.at("deviation").at(name);
      EXPECT_NEAR(found.mean, row.at("mean").at(name).get<double>(), 0.15 * deviation) << name;
      EXPECT_NEAR(found.deviation, deviation, 0.15 * deviation) << name;
    };
    expect_like("log_rate", &FailureRateDraw::log_rate);
    expect_like("slope", &FailureRateDraw::slope);
    expect_like("spread", &FailureRateDraw::spread);
    for (const auto& asked : row.at("predicted")) {
      const std::vector<double> exposures{asked.at("exposure")};
      const auto prediction = predict_success(fit, asked.at("x"), exposures, 0.9, stream(3, "x"));
      EXPECT_NEAR(prediction.rate, asked.at("rate").get<double>(), 0.015) << asked.dump();
    }
  }
}

/// Flights on maps whose failures per metre are exp(-4 - 1.2 z + u), z = (x - 0.6) / 0.2.
std::vector<ExposedTrial> flown(std::size_t map_count, std::size_t missions, double spread,
                                RandomStream& random) {
  std::vector<ExposedTrial> trials;
  for (std::size_t map = 0; map < map_count; ++map) {
    const double x = random.uniform(0.3, 0.9);
    const double rate = math::exp(-4.0 - 1.2 * (x - 0.6) / 0.2 + spread * random.normal());
    for (std::size_t i = 0; i < missions; ++i) {
      const double exposure = random.uniform(10.0, 30.0);
      const bool has_failed = random.uniform() > math::exp(-rate * exposure);
      trials.push_back({.map = map, .x = x, .exposure = exposure, .has_failed = has_failed});
    }
  }
  return trials;
}

// Shares of ten missions are coarse, so that nine of ten intervals hold a little more than that.
TEST(FailureRate, NineOfTenMapsLieWithinTheInterval) {
  int held = 0, asked = 0;
  double predicted = 0.0, observed = 0.0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    RandomStream random(seed);
    const FailureRateFit fit = fit_failure_rate(flown(15, 10, 0.6, random), 1000);
    for (int i = 0; i < 10; ++i) {
      const auto map = flown(1, 10, 0.6, random);
      std::vector<double> exposures;
      double share = 0.0;
      for (const ExposedTrial& trial : map) {
        exposures.push_back(trial.exposure);
        share += trial.has_failed ? 0.0 : 0.1;
      }
      const auto prediction = predict_success(fit, map.front().x, exposures, 0.9, RandomStream(7));
      held += share > prediction.share.lower - 1e-9 && share < prediction.share.upper + 1e-9;
      predicted += prediction.rate;
      observed += share;
      ++asked;
    }
  }
  EXPECT_GT(held, 0.88 * asked);
  EXPECT_LT(held, 0.98 * asked);
  EXPECT_NEAR(predicted / asked, observed / asked, 0.03);
}

TEST(FailureRate, FindsTheSlope) {
  RandomStream random(5);
  const SlopeEstimate slope = failure_slope(fit_failure_rate(flown(100, 10, 0.3, random)), 0.99);
  EXPECT_LT(slope.interval.lower, -1.2 / 0.2);
  EXPECT_GT(slope.interval.upper, -1.2 / 0.2);
  EXPECT_LT(slope.interval.upper, -4.0);
}

TEST(FailureRate, LongerWaysFailMoreOften) {
  RandomStream random(5);
  const FailureRateFit fit = fit_failure_rate(flown(20, 10, 0.0, random));
  const std::vector<double> exposures{1.0, 10.0, 100.0};
  const auto prediction = predict_success(fit, 0.6, exposures, 0.9, RandomStream(1));
  EXPECT_GT(prediction.probabilities[0], prediction.probabilities[1]);
  EXPECT_GT(prediction.probabilities[1], prediction.probabilities[2]);
  // exp(-4) failures a metre.
  EXPECT_NEAR(prediction.probabilities[1], std::exp(-10.0 * std::exp(-4.0)), 0.06);  // 200 flights
  EXPECT_LT(prediction.failures_per_exposure.lower, std::exp(-4.0));
  EXPECT_GT(prediction.failures_per_exposure.upper, std::exp(-4.0));
}

TEST(FailureRate, AnswersOfFewTrials) {
  EXPECT_TRUE(fit_failure_rate({}).draws.empty());
  const double nan = math::kNaN;
  const std::vector<ExposedTrial> unmeasured{{.map = 0, .x = nan, .exposure = 5.0}};
  EXPECT_TRUE(fit_failure_rate(unmeasured).draws.empty());
  const std::vector<ExposedTrial> one{{.map = 0, .x = 0.5, .exposure = 20.0}};
  const FailureRateFit fit = fit_failure_rate(one);
  EXPECT_EQ(fit.scale, 1.0);
  const std::vector<double> exposures{20.0};
  const auto prediction = predict_success(fit, 0.5, exposures, 0.9, RandomStream(1));
  EXPECT_GT(prediction.rate, 0.5);
  EXPECT_LT(prediction.rate, 0.99);
  EXPECT_EQ(prediction.share.lower, 0.0);
  EXPECT_EQ(prediction.share.upper, 1.0);
}

TEST(FailureRate, TheSameTrialsGiveTheSameBits) {
  RandomStream random(9), again(9);
  const auto first = fit_failure_rate(flown(8, 5, 0.5, random), 100);
  const auto second = fit_failure_rate(flown(8, 5, 0.5, again), 100);
  for (std::size_t i = 0; i < first.draws.size(); ++i) {
    EXPECT_EQ(first.draws[i].log_rate, second.draws[i].log_rate);
    EXPECT_EQ(first.draws[i].spread, second.draws[i].spread);
  }
}

}  // namespace
}  // namespace avoidbench
