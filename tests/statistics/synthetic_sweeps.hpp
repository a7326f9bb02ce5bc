#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/rates.hpp"

/// Sweeps whose truth is known: two planners fly the same maps, which differ in difficulty.
namespace avoidbench::synthetic {

constexpr std::int64_t kTrialsPerMap = 10;

/// A map's difficulty is normal with standard deviation 1; a planner's logit of success falls by
/// `logit_spread` with it, and its metric rises by `metric_spread` (metres, say), or by that power
/// of e where `is_skewed`.
struct Population {
  std::array<double, 2> logit = {1.0, 1.8};
  double logit_spread = 1.0;
  double metric_spread = 2.0;
  bool is_skewed = false;

  double rate(double difficulty, std::size_t planner) const {
    return 1.0 / (1.0 + std::exp(logit_spread * difficulty - logit[planner]));
  }
  double metric(double difficulty) const {
    return is_skewed ? std::exp(1.0 + metric_spread * difficulty)
                     : 10.0 + metric_spread * difficulty;
  }
  /// The mean over all maps of `value(difficulty)`.
  static double mean(const std::function<double(double)>& value) {
    double sum = 0.0, weights = 0.0;
    for (int i = -800; i <= 800; ++i) {
      const double difficulty = 0.01 * i;
      const double weight = std::exp(-0.5 * difficulty * difficulty);
      sum += weight * value(difficulty);
      weights += weight;
    }
    return sum / weights;
  }
  double mean_rate(std::size_t planner) const {
    return mean([&](double difficulty) { return rate(difficulty, planner); });
  }
  /// Of the trials that finish, as reports average.
  double mean_metric() const {
    return mean([&](double d) { return rate(d, 0) * metric(d); }) / mean_rate(0);
  }
  double contrast() const {  // both fly missions of the same lengths
    return contrast_factor(mean_rate(0), 1.0, mean_rate(1), 1.0);
  }
};

struct Map {
  std::array<double, 2> rate{};                ///< true, of each planner
  std::array<std::int64_t, 2> finished{};      ///< of kTrialsPerMap
  double length_m = 0.0;                       ///< mean reference path
  std::vector<double> metrics;                 ///< of the finished trials of the first planner
  std::array<std::vector<bool>, 2> successes;  ///< trial by trial
};

/// The planners' difficulties of a map are correlated by 0.64.
inline std::vector<Map> flown(const Population& population, int map_count, RandomStream& random) {
  std::vector<Map> maps(static_cast<std::size_t>(map_count));
  for (Map& map : maps) {
    const double shared = random.normal();
    map.length_m = random.uniform(25.0, 35.0);
    for (const std::size_t planner : {0U, 1U}) {
      const double own = random.normal();
      const double difficulty = 0.8 * shared + 0.6 * own;
      map.rate[planner] = population.rate(difficulty, planner);
      for (std::int64_t trial = 0; trial < kTrialsPerMap; ++trial) {
        const bool is_success = random.uniform() < map.rate[planner];
        const double noise = random.normal();
        map.successes[planner].push_back(is_success);
        if (!is_success) continue;
        map.finished[planner] += 1;
        if (planner == 0) map.metrics.push_back(population.metric(difficulty) + noise);
      }
    }
  }
  return maps;
}

/// In how many of the sweeps an interval held the truth.
struct Coverage {
  int held = 0, all = 0;
  void add(const Interval& interval, double truth) {
    ++all;
    // An unknown end claims nothing.
    held += truth < interval.lower || truth > interval.upper ? 0 : 1;
  }
  double percent() const { return 100.0 * held / all; }
};

/// What a report gives for the maps: the mean of the first planner's metric over its finished
/// trials, by the clusters' sums.
inline Interval mean_interval(const std::vector<Map>& maps, RandomStream random,
                              std::size_t replicates) {
  std::vector<double> sums;
  for (const Map& map : maps) {
    double sum = 0.0;
    for (const double value : map.metrics) sum += value;
    sums.push_back(sum);
  }
  return bca_interval(
      maps.size(),
      [&](std::span<const std::size_t> drawn) {
        double sum = 0.0, count = 0.0;
        for (const std::size_t i : drawn) {
          sum += sums[i];
          count += static_cast<double>(maps[i].metrics.size());
        }
        return count > 0.0 ? sum / count : std::nan("");
      },
      random, replicates);
}

inline Interval contrast_interval(const std::vector<Map>& maps, RandomStream random,
                                  std::size_t replicates) {
  return bca_interval(
      maps.size(),
      [&](std::span<const std::size_t> drawn) {
        std::array<std::int64_t, 2> finished{};
        double length_m = 0.0;
        for (const std::size_t i : drawn) {
          finished[0] += maps[i].finished[0];
          finished[1] += maps[i].finished[1];
          length_m += maps[i].length_m;
        }
        const auto trials = static_cast<std::int64_t>(drawn.size()) * kTrialsPerMap;
        return contrast_factor(jeffreys_rate(finished[0], trials), length_m,
                               jeffreys_rate(finished[1], trials), length_m);
      },
      random, replicates);
}

/// The same mean with trials drawn instead of maps: what one must not do.
inline Interval naive_mean_interval(const std::vector<Map>& maps, RandomStream random,
                                    std::size_t replicates) {
  std::vector<double> values;
  for (const Map& map : maps) values.insert(values.end(), map.metrics.begin(), map.metrics.end());
  return bca_interval(
      values.size(),
      [&](std::span<const std::size_t> drawn) {
        double sum = 0.0;
        for (const std::size_t i : drawn) sum += values[i];
        return sum / static_cast<double>(drawn.size());
      },
      random, replicates);
}

inline Interval naive_contrast_interval(const std::vector<Map>& maps, RandomStream random,
                                        std::size_t replicates) {
  std::vector<std::array<std::int64_t, 2>> pairs;
  for (const Map& map : maps) {
    for (std::size_t trial = 0; trial < map.successes[0].size(); ++trial) {
      pairs.push_back({map.successes[0][trial] ? 1 : 0, map.successes[1][trial] ? 1 : 0});
    }
  }
  return bca_interval(
      pairs.size(),
      [&](std::span<const std::size_t> drawn) {
        std::array<std::int64_t, 2> finished{};
        for (const std::size_t i : drawn) {
          finished[0] += pairs[i][0];
          finished[1] += pairs[i][1];
        }
        const auto trials = static_cast<std::int64_t>(drawn.size());
        return contrast_factor(jeffreys_rate(finished[0], trials), 1.0,
                               jeffreys_rate(finished[1], trials), 1.0);
      },
      random, replicates);
}

struct RateCoverage {
  Coverage wilson;           ///< of all trials, for the rate of all maps
  Coverage wilson_of_flown;  ///< the same for the mean rate of the maps flown
  Coverage clustered;        ///< for the rate of all maps
};

inline RateCoverage rate_coverage(const Population& population, int map_count, int sweeps) {
  RateCoverage coverage;
  const double truth = population.mean_rate(0);
  RandomStream random = stream(1, "sweeps");
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Map> maps = flown(population, map_count, random);
    std::vector<std::int64_t> finished;
    std::int64_t all = 0;
    double flown_rate = 0.0;
    for (const Map& map : maps) {
      finished.push_back(map.finished[0]);
      all += map.finished[0];
      flown_rate += map.rate[0] / map_count;
    }
    const Interval wilson = wilson_interval(all, map_count * kTrialsPerMap);
    coverage.wilson.add(wilson, truth);
    coverage.wilson_of_flown.add(wilson, flown_rate);
    const std::vector<std::int64_t> trials(maps.size(), kTrialsPerMap);
    coverage.clustered.add(clustered_wilson_interval(finished, trials), truth);
  }
  return coverage;
}

struct BootstrapCoverage {
  Coverage mean, contrast, naive_mean, naive_contrast;
};

/// The naive intervals are made for every fifth sweep only.
inline BootstrapCoverage bootstrap_coverage(const Population& population, int map_count, int sweeps,
                                            std::size_t replicates) {
  BootstrapCoverage coverage;
  const double mean = population.mean_metric();
  const double contrast = population.contrast();
  RandomStream random = stream(2, "sweeps");
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Map> maps = flown(population, map_count, random);
    const RandomStream draws(stream_seed(3, static_cast<std::uint64_t>(sweep)));
    coverage.mean.add(mean_interval(maps, draws, replicates), mean);
    coverage.contrast.add(contrast_interval(maps, draws, replicates), contrast);
    if (sweep % 5 != 0) continue;
    coverage.naive_mean.add(naive_mean_interval(maps, draws, replicates), mean);
    coverage.naive_contrast.add(naive_contrast_interval(maps, draws, replicates), contrast);
  }
  return coverage;
}

inline Coverage mean_coverage(const Population& population, int map_count, int sweeps,
                              std::size_t replicates) {
  Coverage coverage;
  const double mean = population.mean_metric();
  RandomStream random = stream(4, "sweeps");
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Map> maps = flown(population, map_count, random);
    const RandomStream draws(stream_seed(5, static_cast<std::uint64_t>(sweep)));
    coverage.add(mean_interval(maps, draws, replicates), mean);
  }
  return coverage;
}

}  // namespace avoidbench::synthetic
