#include "statistics/reached_speed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/normal_quantile.hpp"
#include "base/random.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

/// Planners of which S(v) is known: a flight succeeds with a probability whose logit is normal over
/// maps, at a speed that is normal over maps and, on a map, over missions.
struct Synthetic {
  double logit = 4.0, logit_spread = 0.5;
  double speed_mps = 3.0, map_spread_mps = 0.2, mission_spread_mps = 0.4;

  double success_rate() const {
    double sum = 0.0, weights = 0.0;
    for (int i = -800; i <= 800; ++i) {
      const double z = 0.01 * i, weight = std::exp(-0.5 * z * z);
      sum += weight / (1.0 + std::exp(-logit - logit_spread * z));
      weights += weight;
    }
    return sum / weights;
  }
  /// The v with S(v) = share; 0 where success is rarer.
  double reached_mps(double share) const {
    const double success = success_rate();
    if (success <= share) return 0.0;
    const double spread = std::hypot(map_spread_mps, mission_spread_mps);
    return std::max(0.0, speed_mps - spread * normal_quantile(share / success));
  }
  /// On maps whose difficulties are these; two planners on the same maps share them.
  std::vector<SpeedTrial> flown(const std::vector<std::pair<double, double>>& maps,
                                std::int64_t missions, RandomStream& random) const {
    std::vector<SpeedTrial> trials;
    for (std::size_t map = 0; map < maps.size(); ++map) {
      const auto& [z_success, z_speed] = maps[map];
      const double rate = 1.0 / (1.0 + std::exp(-logit - logit_spread * z_success));
      for (std::int64_t i = 0; i < missions; ++i) {
        const bool is_success = random.uniform() < rate;
        const double speed =
            speed_mps + map_spread_mps * z_speed + mission_spread_mps * random.normal();
        trials.push_back({map, is_success ? std::max(1e-6, speed) : 0.0});
      }
    }
    return trials;
  }
};

std::vector<std::pair<double, double>> drawn_maps(std::size_t count, RandomStream& random) {
  std::vector<std::pair<double, double>> maps(count);
  for (auto& [success, speed] : maps) {
    success = random.normal();
    speed = random.normal();
  }
  return maps;
}

/// Two hundred different ones: rates of success from 0.91 to 0.999, speeds and spreads.
Synthetic planner_of(int number) {
  RandomStream random = stream(static_cast<std::uint64_t>(number), "synthetic planner");
  return {.logit = random.uniform(2.8, 7.0),
          .logit_spread = random.uniform(0.0, 1.0),
          .speed_mps = random.uniform(1.5, 5.0),
          .map_spread_mps = random.uniform(0.0, 0.5),
          .mission_spread_mps = random.uniform(0.2, 1.0)};
}

/// By the definition: of all speeds flown, the greatest that enough flights reach.
double brute_force(const std::vector<SpeedTrial>& trials, double share) {
  double best = 0.0;
  for (const SpeedTrial& candidate : trials) {
    std::size_t reached = 0;
    for (const SpeedTrial& trial : trials) reached += trial.speed_mps >= candidate.speed_mps;
    const bool is_enough =
        static_cast<double>(reached) + 1e-9 >= share * static_cast<double>(trials.size());
    if (is_enough) best = std::max(best, candidate.speed_mps);
  }
  return best;
}

/// S(v) and its interval, counted anew for this v.
std::pair<double, Interval> counted_share(const std::vector<SpeedTrial>& trials, double speed_mps) {
  std::vector<std::int64_t> reached, flown;
  double all = 0.0;
  for (const SpeedTrial& trial : trials) {
    reached.resize(std::max(reached.size(), trial.map + 1));
    flown.resize(reached.size());
    ++flown[trial.map];
    if (trial.speed_mps < speed_mps) continue;
    ++reached[trial.map];
    all += 1.0;
  }
  return {all / static_cast<double>(trials.size()), rate_interval(reached, flown)};
}

TEST(ReachedSpeed, IsTheGreatestSpeedThatEnoughFlightsReach) {
  for (int number = 0; number < 200; ++number) {
    RandomStream random = stream(7, std::to_string(number));
    const auto maps = drawn_maps(1 + random.below(12), random);
    std::vector<SpeedTrial> trials =
        planner_of(number).flown(maps, 1 + static_cast<std::int64_t>(random.below(6)), random);
    // Speeds that several flights have, as those of one vehicle's limit.
    for (SpeedTrial& trial : trials) trial.speed_mps = std::round(10.0 * trial.speed_mps) / 10.0;
    const std::vector<SpeedStep> curve = speed_curve(trials);
    for (const double share : {0.5, 0.9, 1.0}) {
      EXPECT_EQ(reached_speed(curve, share), brute_force(trials, share)) << number;
    }
    for (const SpeedStep& step : curve) {
      const auto [counted, interval] = counted_share(trials, step.speed_mps);
      EXPECT_EQ(step.share, counted);
      EXPECT_NEAR(step.interval.lower, interval.lower, 1e-12);
      EXPECT_NEAR(step.interval.upper, interval.upper, 1e-12);
    }
  }
}

TEST(ReachedSpeed, IntervalHoldsTheSpeedsThatTheRatesIntervalDoesNotRuleOut) {
  for (int number = 0; number < 20; ++number) {
    RandomStream random = stream(8, std::to_string(number));
    const std::vector<SpeedTrial> trials =
        planner_of(number).flown(drawn_maps(12, random), 5, random);
    const Interval interval = reached_speed_interval(speed_curve(trials), 0.9);
    double lowest = 1e9, highest = 0.0;
    for (double v = 0.0025; v < 8.0; v += 0.005) {
      const Interval rate = counted_share(trials, v).second;
      if (!(rate.lower <= 0.9 && rate.upper >= 0.9)) continue;
      lowest = std::min(lowest, v);
      highest = v;
    }
    if (highest == 0.0) continue;  // nine of ten are ruled out at any speed
    EXPECT_NEAR(interval.lower, lowest, 0.0051) << number;
    EXPECT_NEAR(interval.upper, highest, 0.0051) << number;
  }
}

TEST(ReachedSpeed, OfFailuresItIsZero) {
  std::vector<SpeedTrial> trials;
  for (std::size_t i = 0; i < 100; ++i) trials.push_back({i % 10, i < 11 ? 0.0 : 4.0});
  const std::vector<SpeedStep> curve = speed_curve(trials);
  EXPECT_EQ(reached_speed(curve, 0.9), 0.0);
  EXPECT_EQ(reached_speed(curve, 0.5), 4.0);
  EXPECT_EQ(reached_speed_interval(curve, 0.9).lower, 0.0);
  EXPECT_EQ(reached_speed_interval(curve, 0.9).upper, 4.0);
  trials[10].speed_mps = 4.0;  // ten of a hundred fail
  EXPECT_EQ(reached_speed(speed_curve(trials), 0.9), 4.0);
  EXPECT_TRUE(std::isnan(reached_speed({}, 0.9)));
  EXPECT_TRUE(std::isnan(reached_speed_interval({}, 0.9).lower));
}

TEST(ReachedSpeed, NeedsTwentyNineFlights) {
  EXPECT_EQ(least_trials_for(0.9), 29);
  EXPECT_EQ(least_trials_for(0.5), 5);
  // Without failures the two-sided interval leaves 0 a few flights later.
  const auto lower = [](std::size_t flights) {
    std::vector<SpeedTrial> trials(flights, {0, 3.0});
    return reached_speed_interval(speed_curve(trials), 0.9).lower;
  };
  EXPECT_EQ(lower(34), 0.0);
  EXPECT_EQ(lower(35), 3.0);
}

TEST(ReachedSpeed, IntervalsOfSyntheticPlannersHoldTheTruth) {
  for (const std::size_t map_count : {12U, 30U}) {
    int held = 0, all = 0;
    for (int number = 0; number < 200; ++number) {
      const Synthetic planner = planner_of(number);
      RandomStream random = stream(static_cast<std::uint64_t>(number), "coverage");
      for (int sweep = 0; sweep < 20; ++sweep) {
        const auto trials = planner.flown(drawn_maps(map_count, random), 5, random);
        const Interval interval = reached_speed_interval(speed_curve(trials), 0.9);
        const double truth = planner.reached_mps(0.9);
        held += interval.lower <= truth && truth <= interval.upper ? 1 : 0;
        ++all;
      }
    }
    const double percent = 100.0 * held / all;
    std::cout << "    v90 of " << map_count << " maps: " << percent << " %\n";
    EXPECT_GE(percent, 93.0);
    // Sixty flights of twelve maps have coarse steps, and the interval reaches to their ends.
    EXPECT_LE(percent, map_count == 12 ? 98.5 : 97.0);
  }
}

TEST(ReachedSpeed, IntervalsOfDifferencesHoldTheTruth) {
  for (const std::size_t map_count : {12U, 30U}) {
    int held = 0, all = 0;
    for (int number = 0; number < 200; ++number) {
      const Synthetic first = planner_of(number), second = planner_of(number + 1000);
      RandomStream random = stream(static_cast<std::uint64_t>(number), "paired coverage");
      for (int sweep = 0; sweep < 4; ++sweep) {
        const auto maps = drawn_maps(map_count, random);
        const auto of_first = first.flown(maps, 5, random);
        const auto of_second = second.flown(maps, 5, random);
        const Interval interval =
            speed_difference(reached_speed(speed_curve(of_first), 0.9),
                             reached_speed(speed_curve(of_second), 0.9),
                             reached_speed_draws(of_first, map_count, 0.9, 1000),
                             reached_speed_draws(of_second, map_count, 0.9, 1000), map_count)
                .interval;
        const double truth = first.reached_mps(0.9) - second.reached_mps(0.9);
        held += interval.lower <= truth && truth <= interval.upper ? 1 : 0;
        ++all;
      }
    }
    const double percent = 100.0 * held / all;
    std::cout << "    differences of v90 on " << map_count << " maps: " << percent << " %\n";
    EXPECT_GE(percent, 93.0);
    EXPECT_LE(percent, 97.0);
  }
}

}  // namespace
}  // namespace avoidbench
