#include "report/planner_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/bootstrap.hpp"
#include "statistics/ranks.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Sum and count of a metric on one map.
struct MapSum {
  double sum = 0.0, count = 0.0;
};

std::vector<MapSum> sums_by_map(const Trials& trials, std::size_t metric) {
  std::vector<MapSum> sums;
  std::size_t map = 0;
  for (const TrialOnMap& on_map : trials) {
    const double value = on_map.trial->metrics[metric];
    if (std::isnan(value)) continue;
    if (sums.empty() || on_map.map != map) sums.emplace_back();
    map = on_map.map;
    sums.back().sum += value;
    sums.back().count += 1.0;
  }
  return sums;
}

double mean_of(std::span<const MapSum> sums, std::span<const std::size_t> drawn) {
  MapSum all;
  for (const std::size_t map : drawn) {
    all.sum += sums[map].sum;
    all.count += sums[map].count;
  }
  return all.count > 0.0 ? all.sum / all.count : kNaN;
}

MetricMean metric_mean(const Trials& trials, std::size_t metric) {
  MetricMean result;
  const std::vector<MapSum> sums = sums_by_map(trials, metric);
  double sum = 0.0, count = 0.0;
  for (const MapSum& map : sums) {
    sum += map.sum;
    count += map.count;
  }
  result.count = static_cast<std::int64_t>(count);
  result.mean = count > 0.0 ? sum / count : kNaN;
  double squares = 0.0;
  for (const TrialOnMap& on_map : trials) {
    const double deviation = on_map.trial->metrics[metric] - result.mean;
    if (!std::isnan(deviation)) squares += deviation * deviation;
  }
  result.standard_deviation = count > 1.0 ? std::sqrt(squares / (count - 1.0)) : kNaN;
  result.interval = {kNaN, kNaN};
  if (sums.size() >= kLeastMaps) {
    result.interval = bca_interval(
        sums.size(), [&](std::span<const std::size_t> drawn) { return mean_of(sums, drawn); },
        stream(1, "metric_mean"));
  }
  return result;
}

bool is_before(const TrialOnMap& a, const TrialOnMap& b) {
  return std::pair(a.map, a.trial->mission_index) < std::pair(b.map, b.trial->mission_index);
}

/// Mean of the metric over the trials of one mission, from `at` on, which moves behind them.
double mission_mean(const Trials& trials, std::size_t metric, std::size_t& at) {
  MapSum sum;
  const std::size_t first = at;
  for (; at < trials.size() && !is_before(trials[first], trials[at]); ++at) {
    const double value = trials[at].trial->metrics[metric];
    if (std::isnan(value)) continue;
    sum.sum += value;
    sum.count += 1.0;
  }
  return sum.count > 0.0 ? sum.sum / sum.count : kNaN;
}

/// How much greater the metric is in `a` than in `b`, on each mission that has it in both.
std::vector<double> paired_differences(const Trials& a, const Trials& b, std::size_t metric) {
  std::vector<double> differences;
  std::size_t in_a = 0, in_b = 0;
  while (in_a < a.size() && in_b < b.size()) {
    if (is_before(a[in_a], b[in_b])) {
      ++in_a;
    } else if (is_before(b[in_b], a[in_a])) {
      ++in_b;
    } else {
      const double value_a = mission_mean(a, metric, in_a);
      const double value_b = mission_mean(b, metric, in_b);
      if (!std::isnan(value_a) && !std::isnan(value_b)) differences.push_back(value_a - value_b);
    }
  }
  return differences;
}

void mark_best_rate(std::vector<PlannerSummary>& planners) {
  const auto best =
      std::max_element(planners.begin(), planners.end(), [](const auto& a, const auto& b) {
        return a.success_rate < b.success_rate ||
               (std::isnan(a.success_rate) && !std::isnan(b.success_rate));
      });
  const auto comparisons = static_cast<double>(planners.size() - 1);
  best->is_best_rate =
      std::all_of(planners.begin(), planners.end(), [&](const PlannerSummary& other) {
        if (other.planner == best->planner) return true;
        return best->success_rate > other.success_rate &&
               comparisons * fisher_exact_p(best->finished_count, best->trial_count,
                                            other.finished_count, other.trial_count) <
                   kAlpha;
      });
}

void mark_best_mean(std::vector<PlannerSummary>& planners, std::span<const Trials> trials,
                    std::size_t column, std::size_t metric, Better better) {
  if (better == Better::neither) return;
  const double sign = better == Better::more ? 1.0 : -1.0;
  std::size_t best = planners.size();
  for (std::size_t i = 0; i < planners.size(); ++i) {
    const double mean = planners[i].means[column].mean;
    if (std::isnan(mean)) continue;
    if (best == planners.size() || sign * mean > sign * planners[best].means[column].mean) best = i;
  }
  if (best == planners.size()) return;
  const auto comparisons = static_cast<double>(planners.size() - 1);
  for (std::size_t i = 0; i < planners.size(); ++i) {
    if (i == best) continue;
    const RankTest test = wilcoxon_signed_rank(paired_differences(trials[best], trials[i], metric));
    if (sign * test.z <= 0.0 || comparisons * test.p >= kAlpha) return;
  }
  planners[best].means[column].is_best = true;
}

}  // namespace

PlannerSummary planner_summary(std::size_t planner, const Trials& trials,
                               std::span<const std::size_t> metrics) {
  PlannerSummary summary;
  summary.planner = planner;
  summary.trial_count = static_cast<std::int64_t>(trials.size());
  double length_m = 0.0;
  for (const TrialOnMap& on_map : trials) {
    summary.outcome_counts[static_cast<std::size_t>(on_map.trial->outcome)] += 1;
    length_m += on_map.trial->reference_length_m;
  }
  summary.finished_count = summary.outcome_counts[static_cast<std::size_t>(Outcome::reached_goal)];
  const auto count = static_cast<double>(trials.size());
  summary.success_rate = static_cast<double>(summary.finished_count) / count;  // 0 / 0 is NaN
  summary.success_interval = wilson_interval(summary.finished_count, summary.trial_count);
  summary.mean_reference_length_m = length_m / count;
  for (const std::size_t metric : metrics) summary.means.push_back(metric_mean(trials, metric));
  return summary;
}

void mark_best(std::vector<PlannerSummary>& planners, std::span<const Trials> trials,
               std::span<const std::size_t> metrics, std::span<const MetricRow> rows) {
  if (planners.size() < 2) return;
  mark_best_rate(planners);
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    mark_best_mean(planners, trials, i, metrics[i], rows[i].better);
  }
}

}  // namespace avoidbench
