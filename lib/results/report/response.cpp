#include "report/response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/correlation.hpp"
#include "statistics/logistic.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostCurvePoints = 200;

/// The first time at which this end of the curve's interval is at one half or below.
double first_time(const std::vector<SurvivalPoint>& curve, double Interval::*end) {
  const auto found = std::find_if(curve.begin(), curve.end(), [&](const SurvivalPoint& point) {
    // At the curve's end all have arrived, and its interval is of no width.
    return point.survival == 0.0 || point.interval.*end <= 0.5;
  });
  return found == curve.end() ? std::numeric_limits<double>::infinity() : found->time_s;
}

}  // namespace

/// A map is one point of the fit: its trials share its traversability.
DifficultyResponse difficulty_response(std::size_t planner, const Trials& trials,
                                       const std::vector<MapRow>& maps) {
  std::vector<double> traversabilities, rates;
  std::vector<std::int64_t> successes, counts;
  for (const MapCount& count : counts_by_map(trials)) {
    const double traversability = maps[count.map].record.traversability_normalized_ratio;
    // A map whose traversability was not measured.
    if (std::isnan(traversability)) continue;
    traversabilities.push_back(traversability);
    successes.push_back(count.finished);
    counts.push_back(count.trials);
    rates.push_back(count.rate());
  }
  const LogisticFit fit = logistic_fit(traversabilities, successes, counts);
  const double spearman = spearman_correlation(traversabilities, rates);
  return {.planner = planner,
          .map_count = static_cast<std::int64_t>(rates.size()),
          .intercept = fit.intercept,
          .slope = fit.slope,
          .midpoint = fit.midpoint(),
          .midpoint_interval = logistic_midpoint_interval(fit),
          .spearman = spearman,
          // Fisher's z; ranks spread more than values, which `true` asks for.
          .spearman_interval = correlation_interval(spearman, rates.size(), true),
          .is_separated = fit.is_separated};
}

FlightTimes flight_times(std::size_t planner, const Trials& trials) {
  // Failures are followed up to the longest trial's end, which is after every arrival: they never
  // arrive by then.
  double end_s = 0.0;
  for (const TrialOnMap& on_map : trials) end_s = std::max(end_s, on_map.trial->end_time_s);
  std::vector<double> times_s;
  std::vector<bool> has_arrived;
  for (const TrialOnMap& on_map : trials) {
    has_arrived.push_back(on_map.trial->outcome == Outcome::reached_goal);
    times_s.push_back(has_arrived.back() ? on_map.trial->end_time_s : end_s);
  }
  const std::vector<SurvivalPoint> curve = kaplan_meier(times_s, has_arrived);

  FlightTimes result;
  result.planner = planner;
  result.quartiles_s = {survival_quantile(curve, 0.25), survival_quantile(curve, 0.5),
                        survival_quantile(curve, 0.75)};
  // The curve falls, and its interval's lower end falls below one half first.
  result.median_interval_s = {first_time(curve, &Interval::lower),
                              first_time(curve, &Interval::upper)};
  // Thinned for plots; the last point stays, since it has the share that ever arrives.
  // Rounded up, so that there are not more than kMostCurvePoints, and the last.
  const std::size_t step = (curve.size() + kMostCurvePoints - 1) / kMostCurvePoints;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i % step == 0 || i + 1 == curve.size()) result.curve.push_back(curve[i]);
  }
  return result;
}

}  // namespace avoidbench
