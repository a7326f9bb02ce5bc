#include "report/planner_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "base/math.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/ranks.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

/// Sum and count of a metric's values.
struct MetricSum {
  double sum = 0.0, count = 0.0;

  void add(const MetricSum& other) {
    sum += other.sum;
    count += other.count;
  }
  double mean() const { return count > 0.0 ? sum / count : kNaN; }
};

/// The sums of trials with one `key_of(trial)`, which are a run: trials are in order of maps and
/// missions.
template <class KeyOf>
auto sums_by(const Trials& trials, std::size_t metric, KeyOf key_of) {
  std::vector<std::pair<decltype(key_of(trials.front())), MetricSum>> sums;
  for (const TrialOnMap& on_map : trials) {
    const double value = on_map.trial->metrics[metric];
    if (std::isnan(value)) continue;
    const auto key = key_of(on_map);
    if (sums.empty() || sums.back().first != key) sums.emplace_back(key, MetricSum{});
    sums.back().second.add({.sum = value, .count = 1.0});
  }
  return sums;
}

/// BCa bootstrap over maps, not trials: trials of one map resemble each other. NaN for fewer than
/// kLeastMaps.
template <class Statistic>
Interval interval_over_maps(std::size_t map_count, std::string_view name, Statistic statistic) {
  if (map_count < kLeastMaps) return {kNaN, kNaN};
  // A stream of its own, so that the interval is the same in every report.
  return bca_interval(map_count, statistic, stream(1, name));
}

MetricMean metric_mean(const Trials& trials, std::size_t metric) {
  MetricMean result;
  const auto maps = sums_by(trials, metric, [](const TrialOnMap& on_map) { return on_map.map; });
  MetricSum all;
  for (const auto& [map, sum] : maps) all.add(sum);
  result.count = static_cast<std::int64_t>(all.count);
  result.mean = all.mean();
  double squares = 0.0;
  for (const TrialOnMap& on_map : trials) {
    // In a second pass: squares less the squared mean lose digits where the mean is large.
    const double deviation = on_map.trial->metrics[metric] - result.mean;
    if (!std::isnan(deviation)) squares += deviation * deviation;
  }
  result.standard_deviation = all.count > 1.0 ? std::sqrt(squares / (all.count - 1.0)) : kNaN;
  // A map with more trials weighs more, as in the mean that the table shows.
  result.interval = interval_over_maps(maps.size(), "metric_mean", [&](auto drawn) {
    MetricSum of_drawn;
    for (const std::size_t map : drawn) of_drawn.add(maps[map].second);
    return of_drawn.mean();
  });
  return result;
}

/// How much greater the metric is in `a` than in `b`, on each mission that has it in both.
std::vector<double> paired_differences(const Trials& a, const Trials& b, std::size_t metric) {
  // A mission may have several trials, of several settings; they count once, by their mean.
  const auto mission_of = [](const TrialOnMap& on_map) {
    return std::pair(on_map.map, on_map.trial->mission_index);
  };
  const auto of_a = sums_by(a, metric, mission_of), of_b = sums_by(b, metric, mission_of);
  std::vector<double> differences;
  // Both in order of map and mission: one walk.
  auto in_b = of_b.begin();
  for (const auto& [mission, sum] : of_a) {
    while (in_b != of_b.end() && in_b->first < mission) ++in_b;
    if (in_b == of_b.end() || in_b->first != mission) continue;
    differences.push_back(sum.mean() - in_b->second.mean());
  }
  return differences;
}

/// Of two planners, on one map.
using CountPair = std::array<MapCount, 2>;

/// One element a map that either planner flew; the other's counts are zero then.
std::vector<CountPair> pairs_by_map(const Trials& trials_1, const Trials& trials_2) {
  std::map<std::size_t, CountPair> by_map;
  for (const MapCount& count : counts_by_map(trials_1)) by_map[count.map][0] = count;
  for (const MapCount& count : counts_by_map(trials_2)) by_map[count.map][1] = count;
  std::vector<CountPair> pairs;
  for (const auto& [map, pair] : by_map) pairs.push_back(pair);
  return pairs;
}

/// p that two planners' rates are equal on maps like those that both flew; NaN for fewer than
/// kLeastMapsToTest.
double rates_p_over_maps(const std::vector<CountPair>& maps) {
  std::vector<double> differences;
  for (const auto& [count_1, count_2] : maps) {
    if (count_1.trials == 0 || count_2.trials == 0) continue;
    differences.push_back(count_1.rate() - count_2.rate());
  }
  return differences.size() < kLeastMapsToTest ? kNaN : wilcoxon_signed_rank(differences).p;
}

/// The contrast factor over the maps that a bootstrap drew, each as often as it was drawn. Rates
/// are smoothed, since a draw may hold no failure at all, for which the factor is undefined.
double smoothed_factor(const std::vector<CountPair>& maps, std::span<const std::size_t> drawn) {
  std::array<double, 2> rates{}, lengths_m{};
  for (const std::size_t side : {0U, 1U}) {
    MapCount sum;
    for (const std::size_t map : drawn) {
      sum.trials += maps[map][side].trials;
      sum.finished += maps[map][side].finished;
      sum.reference_length_m += maps[map][side].reference_length_m;
    }
    // NaN takes this draw out of the interval.
    if (sum.trials == 0) return kNaN;
    rates[side] = jeffreys_rate(sum.finished, sum.trials);
    lengths_m[side] = sum.reference_length_m / static_cast<double>(sum.trials);
  }
  return contrast_factor(rates[0], lengths_m[0], rates[1], lengths_m[1]);
}

Interval success_interval(const Trials& trials) {
  std::vector<std::int64_t> finished, flown;
  for (const MapCount& count : counts_by_map(trials)) {
    finished.push_back(count.finished);
    flown.push_back(count.trials);
  }
  return rate_interval(finished, flown);
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
  return !(comparisons * rates_p_over_maps(pairs_by_map(trials_a, trials_b)) >= kAlpha);
}

/// The planner of the highest value, NaN left out, if it is clearly better than each of the others.
template <class ValueOf, class IsBetter>
std::optional<std::size_t> clear_best(std::size_t count, ValueOf value_of, IsBetter is_better) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(value_of(i))) continue;
    // The first of equal ones; it is then not significantly better than the other.
    if (!best || value_of(i) > value_of(*best)) best = i;
  }
  for (std::size_t i = 0; best && i < count; ++i) {
    // One that is not clearly worse is enough: then nobody is the best.
    if (i != *best && !is_better(*best, i)) return std::nullopt;
  }
  return best;
}

}  // namespace

std::vector<MapCount> counts_by_map(const Trials& trials) {
  std::vector<MapCount> counts;
  for (const TrialOnMap& on_map : trials) {
    if (counts.empty() || counts.back().map != on_map.map) counts.push_back({.map = on_map.map});
    counts.back().trials += 1;
    counts.back().finished += on_map.trial->outcome == Outcome::reached_goal ? 1 : 0;
    counts.back().reference_length_m += on_map.trial->reference_length_m;
  }
  return counts;
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
  summary.success_interval = success_interval(trials);
  summary.mean_reference_length_m = length_m / count;
  for (const std::size_t metric : metrics) summary.means.push_back(metric_mean(trials, metric));
  return summary;
}

void mark_best(std::vector<PlannerSummary>& planners, std::span<const Trials> trials,
               std::span<const std::size_t> metrics, std::span<const MetricRow> rows) {
  if (planners.size() < 2) return;
  const std::size_t count = planners.size();
  const auto comparisons = static_cast<double>(count - 1);
  const auto best_rate = clear_best(
      count, [&](std::size_t i) { return planners[i].success_rate; },
      [&](std::size_t a, std::size_t b) {
        return is_better_rate(planners[a], trials[a], planners[b], trials[b], comparisons);
      });
  if (best_rate) planners[*best_rate].is_best_rate = true;
  for (std::size_t k = 0; k < metrics.size(); ++k) {
    const Better better = rows[metrics[k]].better;
    if (better == Better::neither) continue;
    const double sign = better == Better::more ? 1.0 : -1.0;
    const auto best_mean = clear_best(
        count, [&](std::size_t i) { return sign * planners[i].means[k].mean; },
        [&](std::size_t a, std::size_t b) {
          // By the missions that both have flown.
          const RankTest test =
              wilcoxon_signed_rank(paired_differences(trials[a], trials[b], metrics[k]));
          // z has the sign of the differences, so a test that is significant the other way does
          // not count.
          return sign * test.z > 0.0 && comparisons * test.p < kAlpha;
        });
    if (best_mean) planners[*best_mean].means[k].is_best = true;
  }
}

Contrast contrast_of(const PlannerSummary& planner_1, const Trials& trials_1,
                     const PlannerSummary& planner_2, const Trials& trials_2) {
  const std::vector<CountPair> maps = pairs_by_map(trials_1, trials_2);
  std::vector<std::size_t> every(maps.size());
  std::iota(every.begin(), every.end(), std::size_t{0});
  return {
      .planner_1 = planner_1.planner,
      .planner_2 = planner_2.planner,
      .factor = contrast_factor(planner_1.success_rate, planner_1.mean_reference_length_m,
                                planner_2.success_rate, planner_2.mean_reference_length_m),
      // Each map once: the estimate itself.
      .smoothed_factor = smoothed_factor(maps, every),
      .smoothed_interval = interval_over_maps(
          maps.size(), "contrast_factor", [&](auto drawn) { return smoothed_factor(maps, drawn); }),
      .fisher_p = fisher_exact_p(planner_1.finished_count, planner_1.trial_count,
                                 planner_2.finished_count, planner_2.trial_count),
      // Fisher's test takes trials for independent; maps like these are another question.
      .map_p = rates_p_over_maps(maps)};
}

}  // namespace avoidbench
