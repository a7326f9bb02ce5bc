#include "metrics/find_maps.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/number_text.hpp"

namespace avoidbench {
namespace {

// Maps of one parameter differ from seed to seed: it is fitted by the mean of three, each of which
// costs a map.
constexpr std::uint64_t kMeanSeeds = 3;
// Twelve halvings of a range of four metres reach the three decimals that parameters have.
constexpr int kHalvings = 12;

/// What was measured before is not measured again.
double measured(const MapTarget& target, double parameter, std::uint64_t seed, MapsFound& found) {
  for (const MapTried& tried : found.tried) {
    if (tried.parameter == parameter && tried.map_seed == seed) return tried.value;
  }
  const double value = target.measure(parameter, seed);
  found.tried.push_back({parameter, seed, value, false});
  return value;
}

/// Over the same seeds for each parameter.
double mean_at(const MapTarget& target, double parameter, MapsFound& found) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= kMeanSeeds; ++seed) {
    sum += measured(target, parameter, seed, found);
  }
  return sum / static_cast<double>(kMeanSeeds);
}

/// The parameter, to three decimals, whose mean is nearest to the wanted value.
double fitting_parameter(const MapTarget& target, MapsFound& found) {
  double low = target.lowest, high = target.highest;
  const double at_low = mean_at(target, low, found), at_high = mean_at(target, high, found);
  const double least = std::min(at_low, at_high), greatest = std::max(at_low, at_high);
  if (!(target.wanted >= least - target.within && target.wanted <= greatest + target.within)) {
    const auto number = [](double value) { return significant_digits(value, 6); };
    throw InputError("no maps of " + number(target.wanted) + " ± " + number(target.within) +
                     ": the measure is " + number(at_low) + " at " + number(low) + " and " +
                     number(at_high) + " at " + number(high));
  }
  double best = std::abs(at_low - target.wanted) < std::abs(at_high - target.wanted) ? low : high;
  double best_error = std::min(std::abs(at_low - target.wanted), std::abs(at_high - target.wanted));
  // A fifth of the tolerance is near enough: single seeds scatter by more.
  for (int i = 0; i < kHalvings && best_error > 0.2 * target.within; ++i) {
    // In thousandths, as parameters are written.
    const double middle = std::round(500.0 * (low + high)) / 1000.0;
    if (middle <= low || middle >= high) break;
    const double value = mean_at(target, middle, found);
    if (std::abs(value - target.wanted) < best_error) {
      best_error = std::abs(value - target.wanted);
      best = middle;
    }
    // Bisection, whichever way the measure goes with the parameter.
    ((value < target.wanted) == (at_low < at_high) ? low : high) = middle;
  }
  return best;
}

}  // namespace

MapsFound find_maps(const MapTarget& target) {
  AB_CHECK(target.within > 0.0 && target.lowest < target.highest, target.within);
  MapsFound found;
  found.parameter = fitting_parameter(target, found);
  for (std::int64_t i = 1; i <= target.most_seeds; ++i) {
    if (static_cast<std::int64_t>(found.seeds.size()) >= target.count) break;
    const auto seed = static_cast<std::uint64_t>(i);
    const double value = measured(target, found.parameter, seed, found);
    if (!(std::abs(value - target.wanted) <= target.within)) continue;
    found.seeds.push_back(seed);
    for (MapTried& tried : found.tried) {
      tried.is_accepted |= tried.parameter == found.parameter && tried.map_seed == seed;
    }
  }
  return found;
}

}  // namespace avoidbench
