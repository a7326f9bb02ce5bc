#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/enum_text.hpp"
#include "statistics/interval.hpp"

/// Where success crosses a level as a field of the sweep changes: a Bayesian fit of a monotone
/// curve, and the trials that tell most of it.
///
/// The field's values are positions from 0 to 1 over its range, equally spaced levels. At position
/// u the rate of success is (1 - lapse) / (1 + exp((u - m) / s)), or the same of m - u where
/// success rises: a logistic curve of width s that even easy trials stay below by the lapse rate
/// (Wichmann and Hill 2001). The limit is the u at which it is the wanted rate. The posterior is
/// exact on a grid of limits, widths, lapse rates and both directions (or the one that is known),
/// each uniform before the first trial (widths by their logarithm).
///
/// Trials on one map are more alike than others. The log likelihood is divided by how much more
/// the maps' sums scatter about the fitted curve than they would if all trials were independent
/// (quasi-likelihood, McCullagh and Nelder 1989, ch. 9), so that intervals speak of other maps.
namespace avoidbench {

/// Trials of one map at one level.
struct LimitCell {
  std::size_t level = 0, map = 0;
  std::int64_t successes = 0, trials = 0;
};

/// What is known beforehand of the way that success goes along the range.
enum class LimitDirection { unknown, falls, rises };
template <>
struct EnumText<LimitDirection> {
  static constexpr std::pair<LimitDirection, std::string_view> entries[] = {
      {LimitDirection::unknown, "unknown"},
      {LimitDirection::falls, "falls"},
      {LimitDirection::rises, "rises"}};
};

/// What is known of a limit.
enum class LimitState {
  found,        ///< success crosses the wanted rate within the range
  all_above,    ///< at the wanted rate or above it in the whole range: the limit is beyond
  all_below,    ///< below it in the whole range: never reached
  not_monotone  ///< success does not go one way with the field: there is no one limit
};

struct LimitEstimate {
  LimitState state = LimitState::found;
  double position = std::numeric_limits<double>::quiet_NaN();  ///< median of the posterior
  Interval interval;       ///< 95 %; an end outside 0 to 1 is infinite: the range does not hold it
  bool is_falling = true;  ///< success falls along the range, as far as is known
  double above = 0.0, below = 0.0;  ///< probabilities of all_above and all_below
  double map_inflation = 1.0;       ///< how much more maps scatter than independent trials, >= 1
  double monotone_p = 1.0;          ///< of rates as little monotone as these, were they monotone
  std::int64_t trials = 0;
  std::vector<double> rates;             ///< expected rate of success at each level
  std::vector<Interval> rate_intervals;  ///< 95 %, of the same

  /// Width of the interval within the range, where an open end counts as the range's.
  double width() const;
};

/// The grid, and what follows from trials on it.
class LimitCurve {
 public:
  /// `level_count` positions from 0 to 1, at least two; `success_rate` in (0, 1).
  LimitCurve(std::size_t level_count, double success_rate,
             LimitDirection direction = LimitDirection::unknown);

  /// Log odds that success falls along the range, by these trials alone.
  double direction(std::span<const LimitCell> cells) const;

  /// All but what a search does not need: rate_intervals, monotone_p and the state not_monotone.
  /// `falls` are the log odds that success falls, before these trials: those of other planners over
  /// the same field, which goes one way for all. Of no account where the direction is known.
  LimitEstimate estimate(std::span<const LimitCell> cells, double falls = 0.0) const;
  LimitEstimate estimate_whole(std::span<const LimitCell> cells, double falls = 0.0) const;

  /// The median of the posterior alone, all trials taken for independent.
  double position(std::span<const LimitCell> cells, double falls = 0.0) const;

  /// Levels of the next `count` trials: each where the limit's variance is expected to be least
  /// after it, given those chosen before; one in eight by turns over all levels, so that a response
  /// that is not monotone shows. `room[level]` more trials can be flown there; fewer than `count`
  /// where room is short.
  std::vector<std::size_t> next(std::span<const LimitCell> cells, std::size_t count,
                                std::vector<std::int64_t> room, double falls = 0.0) const;

  std::size_t level_count() const { return level_count_; }

 private:
  struct Posterior {
    std::vector<double> weights;  ///< of the states, sum 1
    double map_inflation = 1.0;
  };
  Posterior posterior(std::span<const LimitCell> cells, double falls) const;
  std::vector<double> weights_of(std::span<const LimitCell> cells, double inflation,
                                 double falls) const;
  std::vector<double> rates_of(std::span<const double> weights) const;
  LimitCurve() = default;
  LimitCurve only_likely(std::vector<double>& weights) const;
  void learn(std::size_t level, std::vector<double>& weights) const;
  std::size_t most_telling(std::span<const double> weights,
                           std::span<const std::int64_t> room) const;

  double rate(std::size_t level, std::size_t state) const {
    return rates_[level * limits_.size() + state];
  }

  std::size_t level_count_ = 0;
  LimitDirection direction_ = LimitDirection::unknown;
  std::vector<double> limits_;    ///< of each state, position
  std::vector<bool> is_falling_;  ///< of each state
  std::vector<double> rates_;     ///< of each level and state
  std::vector<double> log_rates_, log_failure_rates_;
};

/// Probability, were the best monotone rates the true ones (pooled adjacent violators), of trials
/// that fit rates which turn once as much better as these do, or more: by 399 simulated sets.
/// `inflation`: how much more trials of a map are alike. Where the direction is known, rates that
/// go the other way are not monotone. 1 where fewer than three levels have trials.
double monotone_p(std::span<const LimitCell> cells, std::size_t level_count, double inflation,
                  LimitDirection direction = LimitDirection::unknown);

/// The position, as LimitCurve::position() has it, of as many draws of maps with replacement; the
/// same maps for all that have this seed and number of maps, so that draws of two planners on the
/// same maps are pairs. `cells` are of maps below `map_count`; `falls` as in
/// LimitCurve::estimate().
std::vector<double> limit_draws(const LimitCurve& curve, std::span<const LimitCell> cells,
                                std::size_t map_count, std::uint64_t seed, double falls = 0.0,
                                std::size_t draw_count = 400);

/// For each of several planners over one field the log odds of the others that success falls.
std::vector<double> directions_of_others(const LimitCurve& curve,
                                         std::span<const std::vector<LimitCell>> planners);

/// Of two limits on the same maps, how far they are apart.
struct LimitContrast {
  double difference = 0.0;  ///< of positions, first - second; beyond the range counts as its end
  Interval interval;        ///< 95 %
  double first_is_higher = 0.5;  ///< share of the draws, ties by half
};
LimitContrast limit_contrast(std::span<const double> first, std::span<const double> second);

}  // namespace avoidbench
