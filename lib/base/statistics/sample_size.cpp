#include "statistics/sample_size.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"
#include "statistics/distributions.hpp"

namespace avoidbench {
namespace {

// A thousand such terms are still below a double's last bit beside 1.
constexpr double kNegligible = 1e-18;

void check_ratio(double value, const char* name) {
  if (!(value >= 0.0 && value <= 1.0)) throw InputError(std::string(name) + " is outside [0, 1]");
}

void check_level(double value, const char* name) {
  if (!(value > 0.0 && value < 1.0)) throw InputError(std::string(name) + " is outside (0, 1)");
}

/// P(k) for k = first, first + 1, …: those of a distribution that are not negligible.
struct Probabilities {
  std::int64_t first = 0;
  std::vector<double> values;
  std::int64_t end() const { return first + static_cast<std::int64_t>(values.size()); }
  double operator[](std::int64_t k) const { return values[static_cast<std::size_t>(k - first)]; }
};

/// From the mode, the greatest value, outwards by `ratio(k)` = P(k + 1) / P(k), within [lowest,
/// highest]: sums of hundreds of thousands of terms need no logarithm each, and nothing underflows
/// on the way.
template <class Ratio>
Probabilities around_mode(std::int64_t mode, double at_mode, std::int64_t lowest,
                          std::int64_t highest, const Ratio& ratio) {
  std::vector<double> down;
  double value = at_mode;
  for (std::int64_t k = mode; k > lowest && value > kNegligible;) {
    --k;
    value /= ratio(k);
    down.push_back(value);
  }
  Probabilities result{mode - static_cast<std::int64_t>(down.size()), {down.rbegin(), down.rend()}};
  result.values.push_back(at_mode);
  value = at_mode;
  for (std::int64_t k = mode; k < highest && value > kNegligible; ++k) {
    value *= ratio(k);
    result.values.push_back(value);
  }
  return result;
}

/// Rates of 0 and 1, of which logarithms fail, have one value only.
Probabilities binomial(std::int64_t trials, double rate) {
  if (rate <= 0.0) return {0, {1.0}};
  if (rate >= 1.0) return {trials, {1.0}};
  const auto n = static_cast<double>(trials);
  const auto mode = std::min(trials, static_cast<std::int64_t>((n + 1.0) * rate));
  const auto k = static_cast<double>(mode);
  const double at_mode =
      math::exp(log_choose(n, k) + k * math::log(rate) + (n - k) * math::log(1.0 - rate));
  return around_mode(mode, at_mode, 0, trials, [&](std::int64_t i) {
    const auto from = static_cast<double>(i);
    return (n - from) / (from + 1.0) * rate / (1.0 - rate);
  });
}

/// The greatest k for which a symmetric distribution's tail P(K <= k) is less than `tail`; one less
/// than the first where there is none.
std::int64_t critical_value(const Probabilities& p, double tail) {
  double sum = 0.0;
  for (std::int64_t k = p.first; k < p.end(); ++k) {
    sum += p[k];
    if (!(sum < tail)) return k - 1;
  }
  return p.end() - 1;
}

/// Of equal samples with `successes` in both together: the successes of the first.
Probabilities hypergeometric(std::int64_t trials, std::int64_t successes) {
  const auto n = static_cast<double>(trials);
  const auto s = static_cast<double>(successes);
  const std::int64_t mode = successes / 2;
  const auto k = static_cast<double>(mode);
  const double at_mode =
      math::exp(log_choose(n, k) + log_choose(n, s - k) - log_choose(2.0 * n, s));
  return around_mode(mode, at_mode, std::max<std::int64_t>(0, successes - trials),
                     std::min(trials, successes), [&](std::int64_t i) {
                       const auto from = static_cast<double>(i);
                       return (n - from) / (from + 1.0) * (s - from) / (n - s + from + 1.0);
                     });
}

/// The smallest n from which on `power_of(n)` is at least `power`, near a first `guess`.
std::int64_t smallest_from_which(double guess, double power,
                                 const std::function<double(std::int64_t)>& power_of) {
  const auto around = static_cast<std::int64_t>(std::ceil(guess));
  const auto swing = static_cast<std::int64_t>(10.0 + 3.0 * std::sqrt(guess));  // of the sawtooth
  // Exact power jumps up and down with n, since tests of counts are discrete: it is not enough to
  // find one n that suffices.
  // First a number that suffices, then from a swing above it down to the last that does not.
  std::int64_t above = around + swing;
  while (power_of(above) < power) above += swing;
  std::int64_t last_bad = above;
  // Within one more swing there may be a number that does not suffice.
  for (std::int64_t n = above + swing; n > above; --n) {
    if (power_of(n) < power) return n + 1;
  }
  while (last_bad > 0 && power_of(last_bad) >= power) --last_bad;
  return last_bad + 1;
}

}  // namespace

double hoeffding_trials(double half_width, double confidence) {
  return math::log(2.0 / (1.0 - confidence)) / (2.0 * half_width * half_width);
}

double two_rates_trials(double rate_1, double rate_2, double power, double alpha) {
  // The normal approximation: the pooled variance under equality for the level, each rate's own for
  // the power.
  const double mean = 0.5 * (rate_1 + rate_2);
  const double equal = normal_quantile(1.0 - 0.5 * alpha) * std::sqrt(2.0 * mean * (1.0 - mean));
  const double unequal =
      normal_quantile(power) * std::sqrt(rate_1 * (1.0 - rate_1) + rate_2 * (1.0 - rate_2));
  const double ratio = (equal + unequal) / (rate_1 - rate_2);
  return ratio * ratio;
}

double two_rates_power_exact(double rate_1, double rate_2, std::int64_t trials, double alpha) {
  check_ratio(rate_1, "the first rate");
  check_ratio(rate_2, "the second rate");
  check_level(alpha, "alpha");
  if (trials < 1) return 0.0;
  const Probabilities first = binomial(trials, rate_1);
  const Probabilities second = binomial(trials, rate_2);
  // Over the sum of both successes, on which Fisher's test conditions, and over all splits of it
  // that it calls different.
  double power = 0.0;
  for (std::int64_t sum = first.first + second.first; sum < first.end() + second.end() - 1; ++sum) {
    // Fisher's p is twice the tail, as both samples are of one size.
    const std::int64_t critical = critical_value(hypergeometric(trials, sum), 0.5 * alpha);
    const std::int64_t lowest = std::max(first.first, sum - second.end() + 1);
    const std::int64_t highest = std::min(first.end() - 1, sum - second.first);
    for (std::int64_t k = lowest; k <= std::min(critical, highest); ++k) {
      power += first[k] * second[sum - k];
    }
    for (std::int64_t k = std::max(sum - critical, lowest); k <= highest; ++k) {
      power += first[k] * second[sum - k];
    }
  }
  return std::min(1.0, power);
}

std::int64_t two_rates_trials_exact(double rate_1, double rate_2, double power, double alpha) {
  check_ratio(rate_1, "the first rate");
  check_ratio(rate_2, "the second rate");
  check_level(power, "the power");
  check_level(alpha, "alpha");
  if (rate_1 == rate_2) throw InputError("no number of trials tells equal rates apart");
  const double normal = two_rates_trials(rate_1, rate_2, power, alpha);
  // Casagrande, Pike and Smith's correction for continuity.
  const double root = 1.0 + std::sqrt(1.0 + 4.0 / (normal * std::abs(rate_1 - rate_2)));
  const double corrected = 0.25 * normal * root * root;
  // Exact counts of so many take long, and the corrected normal one is as good.
  if (corrected > 5000.0) return static_cast<std::int64_t>(std::ceil(corrected));
  return smallest_from_which(corrected, power, [&](std::int64_t n) {
    return two_rates_power_exact(rate_1, rate_2, n, alpha);
  });
}

std::int64_t paired_rates_trials(double rate, double change, double discordance, double power,
                                 double alpha) {
  check_ratio(rate, "the rate");
  check_ratio(rate + change, "the changed rate");
  check_ratio(discordance, "the discordance");
  check_level(power, "the power");
  check_level(alpha, "alpha");
  if (change == 0.0) throw InputError("no number of missions tells equal rates apart");
  // The two ways to differ: their sum is the discordance, their difference the change.
  const double only_first = 0.5 * (discordance - change);
  const double only_second = 0.5 * (discordance + change);
  constexpr double kRounding = 1e-12;
  if (only_first < -kRounding || only_second < -kRounding || only_first > rate + kRounding ||
      only_second > 1.0 - rate + kRounding) {
    throw InputError("no two planners have this rate, change and discordance");
  }
  const double ratio =
      (normal_quantile(1.0 - 0.5 * alpha) * std::sqrt(discordance) +
       normal_quantile(power) * std::sqrt(std::max(0.0, discordance - change * change))) /
      change;
  const double normal = ratio * ratio;
  if (normal > 20000.0) return static_cast<std::int64_t>(std::ceil(normal));

  // The power once `differing` missions differ does not depend on the number flown.
  std::vector<double> power_by_differing;
  const auto power_at = [&](std::int64_t differing) {
    const auto i = static_cast<std::size_t>(differing);
    if (i >= power_by_differing.size()) power_by_differing.resize(i + 1, -1.0);
    if (power_by_differing[i] < 0.0) {
      // McNemar's test is a sign test of the missions that differ.
      const std::int64_t critical = critical_value(binomial(differing, 0.5), 0.5 * alpha);
      const Probabilities seen =
          binomial(differing, std::clamp(only_second / discordance, 0.0, 1.0));
      double sum = 0.0;
      for (std::int64_t k = seen.first; k < seen.end(); ++k) {
        if (k <= critical || k >= differing - critical) sum += seen[k];
      }
      power_by_differing[i] = sum;
    }
    return power_by_differing[i];
  };
  return smallest_from_which(normal, power, [&](std::int64_t n) {
    const Probabilities differing = binomial(n, discordance);
    double sum = 0.0;
    for (std::int64_t k = differing.first; k < differing.end(); ++k) {
      sum += differing[k] * power_at(k);
    }
    return sum;
  });
}

std::int64_t wilson_width_trials(double rate, double half_width, double confidence) {
  check_ratio(rate, "the rate");
  check_level(confidence, "the confidence");
  if (!(half_width > 0.0)) throw InputError("the half width must be above 0");
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  const auto half = [&](double n) {
    return z * std::sqrt(rate * (1.0 - rate) / n + 0.25 * z * z / (n * n)) / (1.0 + z * z / n);
  };
  // By doubling, then halving the gap: the width falls with n.
  double above = 1.0;
  while (half(above) > half_width) above *= 2.0;
  double below = std::floor(0.5 * above);
  while (above - below > 1.0) {
    const double middle = std::floor(0.5 * (below + above));
    (half(middle) > half_width ? below : above) = middle;
  }
  return static_cast<std::int64_t>(above);
}

}  // namespace avoidbench
