#include "statistics/reached_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"
#include "base/random.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/distributions.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

/// Counts are whole: a share that rounding put above one is still that share.
constexpr double kShareRounding = 1e-9;

std::vector<SpeedTrial> in_order_of_speed(std::span<const SpeedTrial> trials) {
  std::vector<SpeedTrial> sorted(trials.begin(), trials.end());
  std::sort(sorted.begin(), sorted.end(), [](const SpeedTrial& a, const SpeedTrial& b) {
    return std::tie(a.speed_mps, a.map) < std::tie(b.speed_mps, b.map);
  });
  return sorted;
}

/// Flights of each map that are still as fast, and the sums over maps that an interval needs: as
/// the speed rises, they lose one flight after the other.
class RemainingFlights {
 public:
  RemainingFlights(std::span<const SpeedTrial> trials, double confidence)
      : confidence_(confidence) {
    std::size_t map_count = 0;
    for (const SpeedTrial& trial : trials) map_count = std::max(map_count, trial.map + 1);
    flown_.resize(map_count);
    for (const SpeedTrial& trial : trials) ++flown_[trial.map];
    remaining_ = flown_;
    for (const std::int64_t flown : flown_) sums_.add(flown, flown);
    if (is_clustered()) {
      t_ = student_t_quantile(0.5 + 0.5 * confidence, static_cast<double>(sums_.clusters) - 1.0);
    }
  }

  void drop(std::size_t map) {
    std::int64_t& count = remaining_[map];
    sums_.successes -= 1;
    sums_.success_squares -= 2 * count - 1;
    sums_.products -= flown_[map];
    --count;
  }

  double share() const {
    return static_cast<double>(sums_.successes) / static_cast<double>(sums_.trials);
  }

  /// As rate_interval() has it.
  Interval interval() const {
    if (is_clustered()) return clustered_wilson_interval(sums_, t_);
    return wilson_interval(sums_.successes, sums_.trials, confidence_);
  }

 private:
  bool is_clustered() const { return sums_.clusters >= static_cast<std::int64_t>(kLeastMaps); }

  double confidence_ = 0.95, t_ = 0.0;
  std::vector<std::int64_t> flown_, remaining_;
  ClusterSums sums_;
};

}  // namespace

std::vector<SpeedStep> speed_curve(std::span<const SpeedTrial> trials, double confidence) {
  std::vector<SpeedStep> curve;
  const std::vector<SpeedTrial> sorted = in_order_of_speed(trials);
  RemainingFlights remaining(trials, confidence);
  if (!sorted.empty()) curve.push_back({.share = 1.0, .interval = remaining.interval()});
  for (std::size_t i = 0; i < sorted.size();) {
    const double speed_mps = sorted[i].speed_mps;
    AB_CHECK(speed_mps >= 0.0, speed_mps);
    // S at a speed counts those that have just this one; S(0) is of all.
    if (speed_mps > 0.0) {
      curve.push_back(
          {.speed_mps = speed_mps, .share = remaining.share(), .interval = remaining.interval()});
    }
    for (; i < sorted.size() && sorted[i].speed_mps == speed_mps; ++i) {
      remaining.drop(sorted[i].map);
    }
  }
  return curve;
}

double reached_speed(std::span<const SpeedStep> curve, double share) {
  if (curve.empty()) return kNaN;
  double reached_mps = 0.0;
  for (const SpeedStep& step : curve) {
    if (step.share >= share - kShareRounding) reached_mps = step.speed_mps;
  }
  return reached_mps;
}

Interval reached_speed_interval(std::span<const SpeedStep> curve, double share) {
  if (curve.empty()) return {kNaN, kNaN};
  Interval interval{curve.back().speed_mps, 0.0};
  for (std::size_t i = 1; i < curve.size(); ++i) {
    // S is the same from the step before on: that is where its interval first holds the share.
    if (curve[i].interval.lower <= share) {
      interval.lower = curve[i - 1].speed_mps;
      break;
    }
  }
  for (const SpeedStep& step : curve) {
    if (step.interval.upper >= share) interval.upper = step.speed_mps;
  }
  return interval;
}

std::int64_t least_trials_for(double share) {
  return static_cast<std::int64_t>(std::ceil(math::log(0.05) / math::log(share)));
}

std::vector<double> reached_speed_draws(std::span<const SpeedTrial> trials, std::size_t map_count,
                                        double share, std::size_t draw_count,
                                        std::uint64_t stream_index) {
  const std::vector<SpeedTrial> sorted = in_order_of_speed(trials);
  std::vector<double> flown(map_count, 0.0), weights(map_count);
  for (const SpeedTrial& trial : sorted) flown[trial.map] += 1.0;
  // One stream whatever the planner: the draws of two are pairs.
  RandomStream random = stream(map_count + (stream_index << 32U), "reached_speed_draws");
  std::vector<double> draws(draw_count, kNaN);
  for (double& draw : draws) {
    std::fill(weights.begin(), weights.end(), 0.0);
    double total = 0.0;
    for (std::size_t i = 0; i < map_count; ++i) {
      const auto map = static_cast<std::size_t>(random.below(map_count));
      weights[map] += 1.0;
      total += flown[map];
    }
    if (total == 0.0) continue;
    // Flights may be slower than v_share as long as they are no more than this.
    const double slower = (1.0 - share + kShareRounding) * total;
    double below = 0.0;
    for (const SpeedTrial& trial : sorted) {
      if (weights[trial.map] == 0.0) continue;
      draw = trial.speed_mps;
      below += weights[trial.map];
      if (below > slower) break;
    }
  }
  return draws;
}

SpeedDifference speed_difference(double first_mps, double second_mps,
                                 std::span<const double> first_draws,
                                 std::span<const double> second_draws, std::size_t map_count,
                                 double confidence) {
  SpeedDifference result{.difference_mps = first_mps - second_mps,
                         .interval = {kNaN, kNaN},
                         .spread_mps = kNaN,
                         .p = kNaN};
  if (map_count < kLeastMaps || std::isnan(result.difference_mps)) return result;
  std::vector<double> differences;
  for (std::size_t i = 0; i < first_draws.size(); ++i) {
    const double difference = first_draws[i] - second_draws[i];
    if (!std::isnan(difference)) differences.push_back(difference);
  }
  const auto n = static_cast<double>(map_count);
  // As bca_interval() widens its percentiles.
  const double widened =
      std::sqrt(n / (n - 1.0)) * student_t_quantile(0.5 + 0.5 * confidence, n - 1.0);
  result.interval = {quantile(differences, normal_cdf(-widened)),
                     quantile(differences, normal_cdf(widened))};
  double mean = 0.0, squares = 0.0;
  for (const double one : differences) mean += one / static_cast<double>(differences.size());
  for (const double one : differences) squares += (one - mean) * (one - mean);
  result.spread_mps = std::sqrt(squares / static_cast<double>(differences.size()) * n / (n - 1.0));
  const double difference = std::abs(result.difference_mps);
  // Maps that all differ one way can't say more than this (a sign test).
  const double least_p = std::ldexp(2.0, -static_cast<int>(std::min<std::size_t>(map_count, 1000)));
  result.p = difference == 0.0
                 ? 1.0
                 : std::max(least_p, 2.0 * student_t_tail(difference / result.spread_mps, n - 1.0));
  return result;
}

}  // namespace avoidbench
