#include "report/contrast.hpp"

#include <map>
#include <numeric>

#include "base/math.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/ranks.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

/// What one planner's trials on some maps add up to.
struct Sums {
  std::int64_t trials = 0, finished = 0;
  double length_m = 0.0;

  void add(const Sums& other) {
    trials += other.trials;
    finished += other.finished;
    length_m += other.length_m;
  }
  double smoothed_rate() const { return jeffreys_rate(finished, trials); }
  double mean_length_m() const { return length_m / static_cast<double>(trials); }
};

using SumPair = std::array<Sums, 2>;

/// One element a map that either planner flew; the other's sums are zero then.
std::vector<SumPair> sums_by_map(const Trials& trials_1, const Trials& trials_2) {
  std::map<std::size_t, SumPair> by_map;
  for (const std::size_t side : {0U, 1U}) {
    for (const TrialOnMap& on_map : side == 0 ? trials_1 : trials_2) {
      by_map[on_map.map][side].add(
          {.trials = 1,
           .finished = on_map.trial->outcome == Outcome::reached_goal ? 1 : 0,
           .length_m = on_map.trial->reference_length_m});
    }
  }
  std::vector<SumPair> sums;
  for (const auto& [map, pair] : by_map) sums.push_back(pair);
  return sums;
}

/// The contrast factor over the maps that a bootstrap drew, each as often as it was drawn. Rates
/// are smoothed, since a draw may hold no failure at all, for which the factor is undefined.
double smoothed_factor(const std::vector<SumPair>& maps, std::span<const std::size_t> drawn) {
  SumPair all;
  for (const std::size_t map : drawn) {
    all[0].add(maps[map][0]);
    all[1].add(maps[map][1]);
  }
  // NaN takes this draw out of the interval.
  if (all[0].trials == 0 || all[1].trials == 0) return kNaN;
  return contrast_factor(all[0].smoothed_rate(), all[0].mean_length_m(), all[1].smoothed_rate(),
                         all[1].mean_length_m());
}

}  // namespace

Contrast contrast_of(const PlannerSummary& planner_1, const Trials& trials_1,
                     const PlannerSummary& planner_2, const Trials& trials_2) {
  Contrast contrast;
  contrast.planner_1 = planner_1.planner;
  contrast.planner_2 = planner_2.planner;
  contrast.factor = contrast_factor(planner_1.success_rate, planner_1.mean_reference_length_m,
                                    planner_2.success_rate, planner_2.mean_reference_length_m);
  contrast.fisher_p = fisher_exact_p(planner_1.finished_count, planner_1.trial_count,
                                     planner_2.finished_count, planner_2.trial_count);
  // Fisher's test takes trials for independent; maps like these are another question.
  const std::vector<double> differences = rate_differences(trials_1, trials_2);
  contrast.map_p =
      // With five maps even five equal differences are p = 0.0625: no test could find anything.
      differences.size() < kLeastMapsToTest ? kNaN : wilcoxon_signed_rank(differences).p;

  const std::vector<SumPair> maps = sums_by_map(trials_1, trials_2);
  std::vector<std::size_t> every(maps.size());
  std::iota(every.begin(), every.end(), std::size_t{0});
  // Each map once: the estimate itself.
  contrast.smoothed_factor = smoothed_factor(maps, every);
  contrast.smoothed_interval = {kNaN, kNaN};
  if (maps.size() >= kLeastMaps) {
    // BCa over maps, not trials: trials of one map resemble each other.
    contrast.smoothed_interval = bca_interval(
        maps.size(),
        [&](std::span<const std::size_t> drawn) { return smoothed_factor(maps, drawn); },
        // A stream of its own, so that the interval is the same in every report.
        stream(1, "contrast_factor"));
  }
  return contrast;
}

}  // namespace avoidbench
