#include "config/cross_checks.hpp"

#include <cmath>

#include "base/input_error.hpp"
#include "base/ticks.hpp"
#include "config/yaml_values.hpp"

namespace avoidbench {
namespace {

using Found = std::vector<Contradiction>;

/// The rate nearest to `rate_hz` whose period is a whole number of ticks.
double nearest_rate_hz(double rate_hz) {
  const double exact = static_cast<double>(kTicksPerSecond) / rate_hz;
  const double below = static_cast<double>(kTicksPerSecond) / std::max(1.0, std::floor(exact));
  const double above = static_cast<double>(kTicksPerSecond) / std::max(1.0, std::ceil(exact));
  return std::abs(below - rate_hz) < std::abs(above - rate_hz) ? below : above;
}

void check_rate(const std::string& path, double rate_hz, Found& found) {
  if (period_ticks(rate_hz)) return;
  // Enough digits for the suggestion to be accepted as it is printed.
  const double nearest = nearest_rate_hz(rate_hz);
  found.push_back({path, number_text(rate_hz) +
                             " Hz is not a whole number of ticks of 1/36000 s; the nearest is " +
                             number_text(nearest)});
}

void check_not_faster(const std::string& path, double rate_hz, double physics_hz, Found& found) {
  if (rate_hz <= physics_hz) return;
  found.push_back({path, number_text(rate_hz) + " Hz is faster than rates.physics_hz, " +
                             number_text(physics_hz)});
}

/// The problems of an InputError whose messages begin with "field: ", as fields of `block`.
void add_fields(const std::string& block, const InputError& error, Found& found) {
  for (const InputProblem& problem : error.problems()) {
    const std::size_t colon = problem.message.find(": ");
    const bool has_field = colon != std::string::npos;
    found.push_back({has_field ? block + "." + problem.message.substr(0, colon) : block,
                     has_field ? problem.message.substr(colon + 2) : problem.message});
  }
}

}  // namespace

std::vector<Contradiction> contradictions(const TrialSpec& spec) {
  Found found;
  check_rate("rates.physics_hz", spec.rates.physics_hz, found);
  check_rate("rates.plan_hz", spec.rates.plan_hz, found);
  check_rate("rates.sample_hz", spec.rates.sample_hz, found);
  check_rate("sensor.rate_hz", spec.sensor.rate_hz, found);
  check_not_faster("rates.plan_hz", spec.rates.plan_hz, spec.rates.physics_hz, found);
  check_not_faster("rates.sample_hz", spec.rates.sample_hz, spec.rates.physics_hz, found);
  check_not_faster("sensor.rate_hz", spec.sensor.rate_hz, spec.rates.physics_hz, found);
  if (!(spec.sensor.min_range_m < spec.sensor.max_range_m)) {
    found.push_back({"sensor.min_range_m", number_text(spec.sensor.min_range_m) +
                                               " is not below max_range_m, " +
                                               number_text(spec.sensor.max_range_m)});
  }
  try {
    check_map(spec.map);
  } catch (const InputError& error) {
    add_fields("map", error, found);
  }
  try {
    check_vehicle(spec.vehicle);
  } catch (const InputError& error) {
    const std::string prefix = "vehicle ";
    for (const InputProblem& problem : error.problems()) {
      const bool says_vehicle = problem.message.starts_with(prefix);
      found.push_back({"vehicle", problem.message.substr(says_vehicle ? prefix.size() : 0)});
    }
  }
  return found;
}

}  // namespace avoidbench
