#include "report/planner_summary.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/ranks.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

/// Sum and count of a metric on one map.
struct MapSum {
  double sum = 0.0, count = 0.0;
};

/// Trials are in order of maps, so that a map's are a run.
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

/// The mean over all trials of the drawn maps: a map with more trials weighs more, as in the mean
/// that the table shows. Maps are drawn, not trials, since trials of one map resemble each other.
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
    // In a second pass: squares less the squared mean lose digits where the mean is large.
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
  // Both in order of map and mission: one walk. A mission may have several trials, of several
  // settings; they count once, by their mean.
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

/// Trials and successes on one map.
struct MapCount {
  std::size_t map = 0;
  std::int64_t trials = 0, finished = 0;

  double rate() const { return static_cast<double>(finished) / static_cast<double>(trials); }
};

std::vector<MapCount> counts_by_map(const Trials& trials) {
  std::vector<MapCount> counts;
  for (const TrialOnMap& on_map : trials) {
    if (counts.empty() || counts.back().map != on_map.map) counts.push_back({.map = on_map.map});
    counts.back().trials += 1;
    counts.back().finished += on_map.trial->outcome == Outcome::reached_goal ? 1 : 0;
  }
  return counts;
}

Interval success_interval(const Trials& trials, std::int64_t finished_count) {
  std::vector<std::int64_t> finished, flown;
  for (const MapCount& count : counts_by_map(trials)) {
    finished.push_back(count.finished);
    flown.push_back(count.trials);
  }
  // Few maps don't say how maps differ: then it is the interval of these maps alone.
  if (flown.size() >= kLeastMaps) return clustered_wilson_interval(finished, flown);
  return wilson_interval(finished_count, static_cast<std::int64_t>(trials.size()));
}

/// Whether `a`'s rate is significantly above `b`'s, on these missions and on maps like these.
bool is_better_rate(const PlannerSummary& a, const Trials& trials_a, const PlannerSummary& b,
                    const Trials& trials_b, double comparisons) {
  if (a.success_rate <= b.success_rate) return false;
  // Bonferroni: the best is compared with each of the others.
  const double p = fisher_exact_p(a.finished_count, a.trial_count, b.finished_count, b.trial_count);
  // Fisher's test speaks of these missions; maps like these are for the next one, where there are
  // enough of them to test at all.
  if (comparisons * p >= kAlpha) return false;
  const std::vector<double> differences = rate_differences(trials_a, trials_b);
  return differences.size() < kLeastMapsToTest ||
         comparisons * wilcoxon_signed_rank(differences).p < kAlpha;
}

/// Marks the highest rate if it is significantly higher than each of the others.
void mark_best_rate(std::vector<PlannerSummary>& planners, std::span<const Trials> trials) {
  // NaN, of planners without trials, counts as the lowest.
  const auto best =
      std::max_element(planners.begin(), planners.end(), [](const auto& a, const auto& b) {
        return a.success_rate < b.success_rate ||
               (std::isnan(a.success_rate) && !std::isnan(b.success_rate));
      });
  const auto comparisons = static_cast<double>(planners.size() - 1);
  const auto best_index = static_cast<std::size_t>(best - planners.begin());
  bool is_best = true;
  for (std::size_t i = 0; i < planners.size(); ++i) {
    if (i == best_index) continue;
    is_best =
        is_best && is_better_rate(*best, trials[best_index], planners[i], trials[i], comparisons);
  }
  best->is_best_rate = is_best;
}

/// The same of a metric's means, by the missions that both have flown.
void mark_best_mean(std::vector<PlannerSummary>& planners, std::span<const Trials> trials,
                    std::size_t column, std::size_t metric, Better better) {
  if (better == Better::neither) return;
  const double sign = better == Better::more ? 1.0 : -1.0;
  std::size_t best = planners.size();
  for (std::size_t i = 0; i < planners.size(); ++i) {
    const double mean = planners[i].means[column].mean;
    if (std::isnan(mean)) continue;
    // The first of equal ones; it is then not significantly better than the other.
    if (best == planners.size() || sign * mean > sign * planners[best].means[column].mean) best = i;
  }
  if (best == planners.size()) return;
  const auto comparisons = static_cast<double>(planners.size() - 1);
  for (std::size_t i = 0; i < planners.size(); ++i) {
    if (i == best) continue;
    const RankTest test = wilcoxon_signed_rank(paired_differences(trials[best], trials[i], metric));
    // z has the sign of the differences, so a test that is significant the other way does not
    // count.
    // One that is not clearly worse is enough: then nobody is the best.
    if (sign * test.z <= 0.0 || comparisons * test.p >= kAlpha) return;
  }
  planners[best].means[column].is_best = true;
}

}  // namespace

std::vector<double> rate_differences(const Trials& a, const Trials& b) {
  const std::vector<MapCount> counts_a = counts_by_map(a), counts_b = counts_by_map(b);
  std::vector<double> differences;
  std::size_t in_b = 0;
  // Both in order of maps.
  for (const MapCount& count : counts_a) {
    while (in_b < counts_b.size() && counts_b[in_b].map < count.map) ++in_b;
    if (in_b == counts_b.size() || counts_b[in_b].map != count.map) continue;
    differences.push_back(count.rate() - counts_b[in_b].rate());
  }
  return differences;
}

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
  summary.success_interval = success_interval(trials, summary.finished_count);
  summary.mean_reference_length_m = length_m / count;
  for (const std::size_t metric : metrics) summary.means.push_back(metric_mean(trials, metric));
  return summary;
}

void mark_best(std::vector<PlannerSummary>& planners, std::span<const Trials> trials,
               std::span<const std::size_t> metrics, std::span<const MetricRow> rows) {
  if (planners.size() < 2) return;
  mark_best_rate(planners, trials);
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    mark_best_mean(planners, trials, i, metrics[i], rows[i].better);
  }
}

}  // namespace avoidbench
