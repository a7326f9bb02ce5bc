#include "statistics/survival.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"

namespace avoidbench {
namespace {

using math::kNaN;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// S^exp(±z s / |log S|), with s² Greenwood's sum.
Interval log_log_interval(double survival, double greenwood, double z) {
  // log(-log S) has no value at 0. Bounds in this scale stay within 0 and 1.
  if (!(survival > 0.0)) return {kNaN, kNaN};
  const double log_survival = math::log(survival);
  const double factor = math::exp(z * std::sqrt(greenwood) / -log_survival);
  return {math::exp(log_survival * factor), math::exp(log_survival / factor)};
}

}  // namespace

std::vector<SurvivalPoint> kaplan_meier(std::span<const double> times_s,
                                        const std::vector<bool>& is_event, double confidence) {
  AB_CHECK(times_s.size() == is_event.size(), times_s.size(), is_event.size());
  std::vector<std::size_t> order(times_s.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const double time_s : times_s) AB_CHECK(time_s == time_s);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return times_s[a] < times_s[b]; });
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  std::vector<SurvivalPoint> points;
  double survival = 1.0;
  double greenwood = 0.0;
  // One step for each time: all trials that end at it.
  for (std::size_t first = 0; first < order.size();) {
    const double time_s = times_s[order[first]];
    std::size_t end = first;
    std::int64_t events = 0;
    for (; end < order.size() && times_s[order[end]] == time_s; ++end) {
      events += is_event[order[end]] ? 1 : 0;
    }
    if (events > 0) {
      // All that have not ended before.
      const auto at_risk = static_cast<double>(order.size() - first);
      const double left = at_risk - static_cast<double>(events);
      survival *= left / at_risk;
      // Infinite where none are left; the interval is NaN then.
      greenwood += static_cast<double>(events) / (at_risk * left);
      points.push_back({.time_s = time_s,
                        .survival = survival,
                        .interval = log_log_interval(survival, greenwood, z),
                        .at_risk = static_cast<std::int64_t>(order.size() - first),
                        .events = events});
    }
    first = end;
  }
  return points;
}

double survival_quantile(std::span<const SurvivalPoint> points, double ratio) {
  constexpr double kRounding = 1e-12;  // of the product of the steps
  for (const SurvivalPoint& point : points) {
    if (point.survival <= 1.0 - ratio + kRounding) return point.time_s;
  }
  return kNever;
}

}  // namespace avoidbench
