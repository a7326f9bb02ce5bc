#include "statistics/limit_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/random.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

/// Probability of a limit beyond one end of the range that is enough to say so.
constexpr double kSure = 0.95;

/// Below this probability of a monotone response it is taken for none.
constexpr double kLeastMonotoneP = 0.02;

/// States with less than this share of the likeliest one's weight can't change which trial is next.
constexpr double kLeastShare = 1e-6;

// The grid. Limits half a range beyond both ends stand for all that are farther; there is nothing
// to tell them apart by.
constexpr int kLimits = 97;
constexpr double kLeastLimit = -0.5, kGreatestLimit = 1.5;
constexpr double kStep = (kGreatestLimit - kLeastLimit) / (kLimits - 1);
constexpr int kWidths = 12;
constexpr double kLeastWidth = 0.01, kGreatestWidth = 0.6;
/// Of the greatest lapse rate with which the wanted rate is still reached.
constexpr double kLapses[] = {0.0, 0.15, 0.35, 0.6, 0.85};
/// Rates of 0 and 1 would let one trial exclude a state for good.
constexpr double kLeastRate = 1e-4;

/// How far beyond the range limits are told apart when trials are chosen.
constexpr double kMargin = 0.1;

/// One of as many trials is chosen by turns, not by what it tells of the curve.
constexpr std::size_t kTurn = 12;

double logistic(double x) { return 1.0 / (1.0 + math::exp(-x)); }

std::vector<double> grid_limits() {
  std::vector<double> limits;
  for (int i = 0; i < kLimits; ++i) limits.push_back(kLeastLimit + kStep * i);
  return limits;
}

/// Weights of the grid's limits, of both directions together: each is where the wanted rate is
/// crossed.
std::vector<double> weights_by_limit(std::span<const double> weights) {
  std::vector<double> sums(kLimits, 0.0);
  constexpr std::size_t kShapes = kWidths * std::size(kLapses);
  for (std::size_t i = 0; i < weights.size(); ++i) sums[i / kShapes % kLimits] += weights[i];
  return sums;
}

struct Counts {
  double successes = 0.0, trials = 0.0;
};

std::vector<Counts> by_level(std::span<const LimitCell> cells, std::size_t level_count) {
  std::vector<Counts> levels(level_count);
  for (const LimitCell& cell : cells) {
    levels[cell.level].successes += static_cast<double>(cell.successes);
    levels[cell.level].trials += static_cast<double>(cell.trials);
  }
  return levels;
}

/// How much more the maps' successes scatter about these rates than independent trials do.
double inflation_of(std::span<const LimitCell> cells, std::span<const double> rates) {
  struct Map {
    double residual = 0.0, variance = 0.0;
  };
  std::map<std::size_t, Map> maps;
  for (const LimitCell& cell : cells) {
    const double rate = rates[cell.level], trials = static_cast<double>(cell.trials);
    Map& map = maps[cell.map];
    map.residual += static_cast<double>(cell.successes) - trials * rate;
    map.variance += trials * rate * (1.0 - rate);
  }
  if (maps.size() < kLeastMaps) return 1.0;
  double scatter = 0.0, expected = 0.0;
  for (const auto& [number, map] : maps) {
    scatter += map.residual * map.residual;
    expected += map.variance;
  }
  return std::max(1.0, scatter / expected);
}

/// The x at which the distribution of weights over increasing xs, each spread evenly over a cell of
/// width `step`, has this probability below it.
double quantile_of(std::span<const double> x, std::span<const double> weights, double step,
                   double probability) {
  double below = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (below + weights[i] >= probability && weights[i] > 0.0) {
      return x[i] + step * ((probability - below) / weights[i] - 0.5);
    }
    below += weights[i];
  }
  return x.back();
}

/// The quantile of values with weights.
double weighted_quantile(std::vector<std::pair<double, double>>& values, double probability) {
  double below = 0.0;
  for (const auto& [value, weight] : values) {
    below += weight;
    if (below >= probability) return value;
  }
  return values.back().first;
}

/// Pooled adjacent violators: the likeliest rates that do not rise from level to level. Levels
/// without trials are left out.
std::vector<double> falling_rates(std::span<const Counts> levels) {
  struct Pool {
    double successes = 0.0, trials = 0.0;
    std::size_t count = 0;
    double rate() const { return successes / trials; }
  };
  std::vector<Pool> pools;
  for (const Counts& level : levels) {
    pools.push_back({level.successes, level.trials, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].rate() < pools.back().rate()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().successes += last.successes;
      pools.back().trials += last.trials;
      pools.back().count += last.count;
    }
  }
  std::vector<double> rates;
  for (const Pool& pool : pools) rates.insert(rates.end(), pool.count, pool.rate());
  return rates;
}

double log_likelihood(std::span<const Counts> levels, std::span<const double> rates) {
  double sum = 0.0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double failures = levels[i].trials - levels[i].successes;
    // 0 log 0 is 0.
    if (levels[i].successes > 0.0) sum += levels[i].successes * math::log(rates[i]);
    if (failures > 0.0) sum += failures * math::log(1.0 - rates[i]);
  }
  return sum;
}

std::vector<double> rising_rates(std::span<const Counts> levels) {
  const std::vector<Counts> backward(levels.rbegin(), levels.rend());
  std::vector<double> rates = falling_rates(backward);
  std::reverse(rates.begin(), rates.end());
  return rates;
}

struct Monotone {
  std::vector<double> rates;
  double deviance = 0.0;  ///< of these rates against the best that turn once
};

/// The better of the falling and the rising rates, or those of the direction that is known, and how
/// much better rates fit that fall up to some level and rise from there on, or the other way round.
/// Against each level's own rate, which most sets of few trials fit far better, a dip would hardly
/// show.
Monotone best_monotone(std::span<const Counts> levels, LimitDirection direction) {
  const std::vector<double> falling = falling_rates(levels), rising = rising_rates(levels);
  const double as_falling = log_likelihood(levels, falling);
  const double as_rising = log_likelihood(levels, rising);
  double best = std::max(as_falling, as_rising);
  for (std::size_t turn = 1; turn < levels.size(); ++turn) {
    const std::span<const Counts> before = levels.first(turn), after = levels.subspan(turn);
    // Whatever lies between the two parts, each fits by itself.
    const double valley =
        log_likelihood(before, falling_rates(before)) + log_likelihood(after, rising_rates(after));
    const double hill =
        log_likelihood(before, rising_rates(before)) + log_likelihood(after, falling_rates(after));
    best = std::max({best, valley, hill});
  }
  const bool is_rising = direction == LimitDirection::unknown ? as_rising > as_falling
                                                              : direction == LimitDirection::rises;
  if (is_rising) return {rising, 2.0 * (best - as_rising)};
  return {falling, 2.0 * (best - as_falling)};
}

}  // namespace

double LimitEstimate::width() const {
  return std::min(interval.upper, 1.0) - std::max(interval.lower, 0.0);
}

LimitCurve::LimitCurve(std::size_t level_count, double success_rate, LimitDirection direction)
    : level_count_(level_count), direction_(direction) {
  AB_CHECK(level_count >= 2 && success_rate > 0.0 && success_rate < 1.0, level_count, success_rate);
  struct Shape {
    double width = 0.0, lapse = 0.0;
  };
  std::vector<Shape> shapes;
  for (const bool is_falling : {true, false}) {
    if (direction == (is_falling ? LimitDirection::rises : LimitDirection::falls)) continue;
    for (int i = 0; i < kLimits; ++i) {
      for (int k = 0; k < kWidths; ++k) {
        for (const double lapse : kLapses) {
          limits_.push_back(kLeastLimit + kStep * i);
          is_falling_.push_back(is_falling);
          shapes.push_back(
              {kLeastWidth * math::pow(kGreatestWidth / kLeastWidth, 1.0 * k / (kWidths - 1)),
               lapse * (1.0 - success_rate)});
        }
      }
    }
  }
  rates_.reserve(level_count * limits_.size());
  for (std::size_t level = 0; level < level_count; ++level) {
    const double u = static_cast<double>(level) / static_cast<double>(level_count - 1);
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const auto& [width, lapse] = shapes[i];
      // The logistic curve's logit at the limit, where the rate is the wanted one.
      const double share = success_rate / (1.0 - lapse);
      const double logit = math::log(share / (1.0 - share));
      const double along = (u - limits_[i]) / width * (is_falling_[i] ? -1.0 : 1.0);
      const double rate = (1.0 - lapse) * logistic(logit + along);
      rates_.push_back(std::clamp(rate, kLeastRate, 1.0 - kLeastRate));
    }
  }
  for (const double rate : rates_) {
    log_rates_.push_back(math::log(rate));
    log_failure_rates_.push_back(math::log(1.0 - rate));
  }
}

std::vector<double> LimitCurve::weights_of(std::span<const LimitCell> cells, double inflation,
                                           double falls) const {
  const std::size_t state_count = limits_.size();
  std::vector<double> weights(state_count, 0.0);
  const std::vector<Counts> levels = by_level(cells, level_count_);
  for (std::size_t level = 0; level < level_count_; ++level) {
    const auto& [successes, trials] = levels[level];
    if (trials == 0.0) continue;
    const double* log_rate = &log_rates_[level * state_count];
    const double* log_failure_rate = &log_failure_rates_[level * state_count];
    for (std::size_t i = 0; i < state_count; ++i) {
      weights[i] += successes * log_rate[i] + (trials - successes) * log_failure_rate[i];
    }
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = weights[i] / inflation + (is_falling_[i] ? 0.5 : -0.5) * falls;
  }
  const double greatest = *std::max_element(weights.begin(), weights.end());
  double sum = 0.0;
  for (double& weight : weights) {
    weight = math::exp(weight - greatest);
    sum += weight;
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<double> LimitCurve::rates_of(std::span<const double> weights) const {
  std::vector<double> rates(level_count_, 0.0);
  for (std::size_t level = 0; level < level_count_; ++level) {
    for (std::size_t i = 0; i < weights.size(); ++i) rates[level] += weights[i] * rate(level, i);
  }
  return rates;
}

LimitCurve::Posterior LimitCurve::posterior(std::span<const LimitCell> cells, double falls) const {
  Posterior result{.weights = weights_of(cells, 1.0, falls)};
  result.map_inflation = inflation_of(cells, rates_of(result.weights));
  if (result.map_inflation > 1.0) result.weights = weights_of(cells, result.map_inflation, falls);
  return result;
}

double LimitCurve::direction(std::span<const LimitCell> cells) const {
  const std::vector<double> weights = posterior(cells, 0.0).weights;
  double falling = 0.0, rising = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    (is_falling_[i] ? falling : rising) += weights[i];
  }
  // Sure enough; and sums of odds stay finite.
  constexpr double kLeast = 1e-12;
  return math::log(std::max(falling, kLeast) / std::max(rising, kLeast));
}

LimitEstimate LimitCurve::estimate(std::span<const LimitCell> cells, double falls) const {
  LimitEstimate result;
  const Posterior found = posterior(cells, falls);
  const std::vector<double>& weights = found.weights;
  result.map_inflation = found.map_inflation;
  result.rates = rates_of(weights);
  double falling = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (is_falling_[i]) falling += weights[i];
    const bool is_before = limits_[i] < 0.0;
    const bool is_after = limits_[i] > 1.0;
    if (is_falling_[i] ? is_after : is_before) result.above += weights[i];
    if (is_falling_[i] ? is_before : is_after) result.below += weights[i];
  }
  result.is_falling = falling >= 0.5;
  const std::vector<double> limits = grid_limits(), limit_weights = weights_by_limit(weights);
  result.position = quantile_of(limits, limit_weights, kStep, 0.5);
  result.interval = {quantile_of(limits, limit_weights, kStep, 0.025),
                     quantile_of(limits, limit_weights, kStep, 0.975)};
  if (result.interval.lower < 0.0) result.interval.lower = -std::numeric_limits<double>::infinity();
  if (result.interval.upper > 1.0) result.interval.upper = std::numeric_limits<double>::infinity();
  for (const LimitCell& cell : cells) result.trials += cell.trials;
  if (result.above > kSure) {
    result.state = LimitState::all_above;
  } else if (result.below > kSure) {
    result.state = LimitState::all_below;
  }
  return result;
}

LimitEstimate LimitCurve::estimate_whole(std::span<const LimitCell> cells, double falls) const {
  LimitEstimate result = estimate(cells, falls);
  const std::vector<double> weights = weights_of(cells, result.map_inflation, falls);
  std::vector<std::pair<double, double>> values(weights.size());
  for (std::size_t level = 0; level < level_count_; ++level) {
    for (std::size_t i = 0; i < weights.size(); ++i) values[i] = {rate(level, i), weights[i]};
    std::sort(values.begin(), values.end());
    result.rate_intervals.push_back(
        {weighted_quantile(values, 0.025), weighted_quantile(values, 0.975)});
  }
  result.monotone_p = monotone_p(cells, level_count_, result.map_inflation, direction_);
  if (result.monotone_p < kLeastMonotoneP) result.state = LimitState::not_monotone;
  return result;
}

double LimitCurve::position(std::span<const LimitCell> cells, double falls) const {
  return quantile_of(grid_limits(), weights_by_limit(weights_of(cells, 1.0, falls)), kStep, 0.5);
}

/// `weights` become those of the states that are left.
LimitCurve LimitCurve::only_likely(std::vector<double>& weights) const {
  const double least = kLeastShare * *std::max_element(weights.begin(), weights.end());
  std::vector<std::size_t> states;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] >= least) states.push_back(i);
  }
  LimitCurve result;
  result.level_count_ = level_count_;
  std::vector<double> kept;
  double sum = 0.0;
  for (const std::size_t i : states) {
    kept.push_back(weights[i]);
    sum += weights[i];
    result.limits_.push_back(limits_[i]);
    result.is_falling_.push_back(is_falling_[i]);
  }
  for (std::size_t level = 0; level < level_count_; ++level) {
    for (const std::size_t i : states) {
      const std::size_t at = level * limits_.size() + i;
      result.rates_.push_back(rates_[at]);
      result.log_rates_.push_back(log_rates_[at]);
      result.log_failure_rates_.push_back(log_failure_rates_[at]);
    }
  }
  for (double& weight : kept) weight /= sum;
  weights = std::move(kept);
  return result;
}

/// As if a trial there had ended by as much as is expected: the next one is to tell something else.
void LimitCurve::learn(std::size_t level, std::vector<double>& weights) const {
  const std::size_t first = level * limits_.size();
  double expected = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) expected += weights[i] * rates_[first + i];
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= math::exp(expected * log_rates_[first + i] +
                            (1.0 - expected) * log_failure_rates_[first + i]);
    sum += weights[i];
  }
  for (double& weight : weights) weight /= sum;
}

/// The expected variance after a trial is that of its two ends, each with its probability. Their
/// sum is the variance now less what the trial is expected to tell.
std::size_t LimitCurve::most_telling(std::span<const double> weights,
                                     std::span<const std::int64_t> room) const {
  std::vector<double> limit(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    limit[i] = std::clamp(limits_[i], -kMargin, 1.0 + kMargin);
  }
  double mean = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) mean += weights[i] * limit[i];
  std::size_t best = level_count_;
  double most_told = -1.0;
  for (std::size_t level = 0; level < level_count_; ++level) {
    if (room[level] <= 0) continue;
    double success = 0.0, success_limit = 0.0;
    const double* rates = &rates_[level * weights.size()];
    for (std::size_t i = 0; i < weights.size(); ++i) {
      success += weights[i] * rates[i];
      success_limit += weights[i] * rates[i] * limit[i];
    }
    // Variance of the two ends' means about the mean of all.
    const double deviation = success_limit - success * mean;
    const double told = deviation * deviation / (success * (1.0 - success));
    if (told > most_told) {
      most_told = told;
      best = level;
    }
  }
  return best;
}

std::vector<std::size_t> LimitCurve::next(std::span<const LimitCell> cells, std::size_t count,
                                          std::vector<std::int64_t> room, double falls) const {
  AB_CHECK(room.size() == level_count_, room.size());
  std::size_t flown = 0;
  for (const LimitCell& cell : cells) flown += static_cast<std::size_t>(cell.trials);
  std::vector<double> weights = posterior(cells, falls).weights;
  const LimitCurve likely = only_likely(weights);
  std::vector<std::size_t> levels;
  for (std::size_t k = 0; k < count; ++k) {
    if (std::none_of(room.begin(), room.end(), [](std::int64_t left) { return left > 0; })) break;
    std::size_t level = level_count_;
    // The golden ratio's multiples visit a range evenly, wherever one stops.
    const std::size_t number = (flown + k) / kTurn;
    if ((flown + k) % kTurn == 0) {
      const double turn = static_cast<double>(number) * 0.6180339887498949;
      level =
          static_cast<std::size_t>((turn - std::floor(turn)) * static_cast<double>(level_count_));
    }
    if (level >= level_count_ || room[level] <= 0) level = likely.most_telling(weights, room);
    levels.push_back(level);
    --room[level];
    likely.learn(level, weights);
  }
  return levels;
}

double monotone_p(std::span<const LimitCell> cells, std::size_t level_count, double inflation,
                  LimitDirection direction) {
  std::vector<Counts> levels = by_level(cells, level_count);
  std::erase_if(levels, [](const Counts& level) { return level.trials == 0.0; });
  if (levels.size() < 3) return 1.0;
  const Monotone fit = best_monotone(levels, direction);
  RandomStream random = stream(levels.size(), "monotone_p");
  constexpr int kDraws = 399;
  int as_bad = 0;
  std::vector<Counts> drawn = levels;
  for (int draw = 0; draw < kDraws; ++draw) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
      drawn[i].successes = 0.0;
      for (int k = 0; k < static_cast<int>(levels[i].trials); ++k) {
        if (random.uniform() < fit.rates[i]) drawn[i].successes += 1.0;
      }
    }
    if (best_monotone(drawn, direction).deviance >= fit.deviance / inflation - 1e-9) ++as_bad;
  }
  return (as_bad + 1.0) / (kDraws + 1.0);
}

std::vector<double> directions_of_others(const LimitCurve& curve,
                                         std::span<const std::vector<LimitCell>> planners) {
  std::vector<double> directions;
  double sum = 0.0;
  for (const std::vector<LimitCell>& cells : planners) {
    directions.push_back(curve.direction(cells));
    sum += directions.back();
  }
  for (double& direction : directions) direction = sum - direction;
  return directions;
}

std::vector<double> limit_draws(const LimitCurve& curve, std::span<const LimitCell> cells,
                                std::size_t map_count, std::uint64_t seed, double falls,
                                std::size_t draw_count) {
  std::vector<std::vector<LimitCell>> of_map(map_count);
  for (const LimitCell& cell : cells) of_map[cell.map].push_back(cell);
  RandomStream random = stream(seed, "limit_draws");
  std::vector<double> draws;
  std::vector<LimitCell> drawn;
  for (std::size_t i = 0; i < draw_count; ++i) {
    drawn.clear();
    for (std::size_t k = 0; k < map_count; ++k) {
      const std::vector<LimitCell>& map = of_map[random.below(map_count)];
      drawn.insert(drawn.end(), map.begin(), map.end());
    }
    draws.push_back(curve.position(drawn, falls));
  }
  return draws;
}

LimitContrast limit_contrast(std::span<const double> first, std::span<const double> second) {
  AB_CHECK(first.size() == second.size() && !first.empty(), first.size(), second.size());
  std::vector<double> differences;
  LimitContrast result{.difference = 0.0, .interval = {}, .first_is_higher = 0.0};
  for (std::size_t i = 0; i < first.size(); ++i) {
    differences.push_back(std::clamp(first[i], 0.0, 1.0) - std::clamp(second[i], 0.0, 1.0));
    // A tie says as much for one as for the other.
    result.first_is_higher += differences[i] > 0.0 ? 1.0 : differences[i] < 0.0 ? 0.0 : 0.5;
  }
  result.first_is_higher /= static_cast<double>(first.size());
  std::sort(differences.begin(), differences.end());
  result.difference = quantile(differences, 0.5);
  result.interval = {quantile(differences, 0.025), quantile(differences, 0.975)};
  return result;
}

}  // namespace avoidbench
