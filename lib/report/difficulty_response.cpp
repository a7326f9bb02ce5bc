#include "report/difficulty_response.hpp"

#include <cmath>

#include "statistics/correlation.hpp"
#include "statistics/logistic.hpp"

namespace avoidbench {

/// A map is one point of the fit: its trials share its traversability.
DifficultyResponse difficulty_response(std::size_t planner, const Trials& trials,
                                       const std::vector<MapRow>& maps) {
  std::vector<double> traversabilities, rates;
  std::vector<std::int64_t> successes, counts;
  // Trials are in order of maps: a run of them is a map.
  for (std::size_t first = 0; first < trials.size();) {
    const std::size_t map = trials[first].map;
    std::int64_t count = 0, success_count = 0;
    for (; first < trials.size() && trials[first].map == map; ++first) {
      ++count;
      success_count += trials[first].trial->outcome == Outcome::reached_goal ? 1 : 0;
    }
    const double traversability = maps[map].record.traversability_normalized_ratio;
    // A map whose traversability was not measured.
    if (std::isnan(traversability)) continue;
    traversabilities.push_back(traversability);
    successes.push_back(success_count);
    counts.push_back(count);
    rates.push_back(static_cast<double>(success_count) / static_cast<double>(count));
  }
  const LogisticFit fit = logistic_fit(traversabilities, successes, counts);
  DifficultyResponse response;
  response.planner = planner;
  response.map_count = static_cast<std::int64_t>(rates.size());
  response.intercept = fit.intercept;
  response.slope = fit.slope;
  response.midpoint = fit.midpoint();
  response.midpoint_interval = logistic_midpoint_interval(fit);
  response.is_separated = fit.is_separated;
  response.spearman = spearman_correlation(traversabilities, rates);
  // Fisher's z; ranks spread more than values, which `true` asks for.
  response.spearman_interval = correlation_interval(response.spearman, rates.size(), true);
  return response;
}

}  // namespace avoidbench
