#include "compare/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "base/input_error.hpp"
#include "base/normal_quantile.hpp"
#include "base/words.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/ranks.hpp"
#include "statistics/rates.hpp"
#include "statistics/reached_speed.hpp"

namespace avoidbench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kSuccessRate = "success_rate";
constexpr std::string_view kV90 = "v90_mps";
constexpr const char* kGoalVelocity = "average_goal_velocity_mps";
/// Few: Holm's correction over all thirty would hide losses that five tests show.
constexpr std::array<std::string_view, 6> kUsualMetrics{
    "path_optimality_pct",  "energy_optimality", "average_goal_velocity_mps",
    "mission_progress_pct", "min_clearance_m",   "processing_time_ms"};
/// Metrics that no failure improves: they are at their best in every finished trial.
constexpr std::array<std::string_view, 3> kOfFailuresToo{
    "mission_progress_pct", "relative_end_distance_ratio", "collision_count"};
/// Above it the normal interval, whose error falls with the number of maps, is as good as the
/// bootstrap's, and the jackknife in that one would take long.
constexpr std::size_t kMostBootstrapMaps = 300;

bool finished(const TableTrial& trial) { return trial.outcome == Outcome::reached_goal; }

/// A pair of values and the map that they are from.
struct PairValue {
  std::uint64_t map;
  double before, after;
};

/// Sums of one map.
struct MapSums {
  double count = 0.0, before = 0.0, after = 0.0;
};

/// In order of the maps' digests, so that sums and draws are the same on every run.
std::vector<MapSums> sums_by_map(const std::vector<PairValue>& values) {
  std::map<std::uint64_t, MapSums> by_map;
  for (const PairValue& value : values) {
    MapSums& sums = by_map[value.map];
    sums.count += 1.0;
    sums.before += value.before;
    sums.after += value.after;
  }
  std::vector<MapSums> maps;
  for (const auto& [map, sums] : by_map) maps.push_back(sums);
  return maps;
}

/// The interval of a mean of all values, given each map's sum of them and count.
Interval mean_interval(const std::vector<double>& sums, const std::vector<double>& counts,
                       std::string_view name, std::size_t replicate_count) {
  // One map says nothing of how maps differ.
  if (sums.size() < 2) return {kNaN, kNaN};
  const auto mean_of = [&](std::span<const std::size_t> drawn) {
    double sum = 0.0, count = 0.0;
    for (const std::size_t map : drawn) {
      sum += sums[map];
      count += counts[map];
    }
    return sum / count;
  };
  // Each interval draws from a stream of its name: other rows do not change it.
  if (sums.size() <= kMostBootstrapMaps) {
    return bca_interval(sums.size(), mean_of, stream(1, name), replicate_count);
  }
  // The mean is a ratio, sum over count, of which both vary from map to map; its variance is that
  // of the residuals sum − mean × count (linearised ratio estimator).
  double sum = 0.0, count = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sum += sums[i];
    count += counts[i];
  }
  const double mean = sum / count;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double residual = sums[i] - mean * counts[i];
    squares += residual * residual;
  }
  const double half_width = normal_quantile(0.975) * std::sqrt(squares) / count;
  return {mean - half_width, mean + half_width};
}

/// Fills in means, change, intervals and p from the values of the pairs.
void fill_figures(const std::vector<PairValue>& values, std::size_t replicate_count,
                  MetricComparison& row) {
  row.pair_count = static_cast<std::int64_t>(values.size());
  // What can't be known stays NaN, and a row of NaN is not gated.
  row.base_mean = row.new_mean = row.change = row.p = row.adjusted_p = kNaN;
  row.change_interval = row.new_interval = {kNaN, kNaN};
  if (values.empty()) return;
  std::vector<double> differences, changes, sums, counts;
  double before = 0.0, after = 0.0;
  for (const MapSums& map : sums_by_map(values)) {
    before += map.before;
    after += map.after;
    changes.push_back(map.after - map.before);
    sums.push_back(map.after);
    counts.push_back(map.count);
  }
  std::int64_t lost = 0, gained = 0;
  bool is_equal = true;
  for (const PairValue& value : values) {
    differences.push_back(value.after - value.before);
    lost += value.before > value.after ? 1 : 0;
    gained += value.after > value.before ? 1 : 0;
    is_equal = is_equal && value.after == value.before;
  }
  const auto count = static_cast<double>(values.size());
  row.base_mean = before / count;
  row.new_mean = after / count;
  // Rounding of the sums is no change.
  row.change = is_equal ? 0.0 : row.new_mean - row.base_mean;
  row.change_interval = mean_interval(changes, counts, "compare change", replicate_count);
  row.new_interval = mean_interval(sums, counts, "compare new", replicate_count);
  // McNemar's test sees only the pairs that ended differently; the differences of the others need
  // ranks, since they are far from normal.
  // Of 0 and 1 a rank test would count the ties of all that ended alike.
  if (row.metric == kSuccessRate) {
    row.p = mcnemar_exact_p(lost, gained);
  } else {
    row.p = is_equal ? 1.0 : wilcoxon_signed_rank(differences).p;
  }
}

/// The values of the pairs that a metric speaks of (see compare.hpp); the success rate is a metric
/// of 0 and 1.
std::vector<PairValue> values_of(const TrialTable& base, const TrialTable& now,
                                 const std::vector<TrialPair>& pairs, const std::string& metric) {
  std::vector<PairValue> values;
  if (metric == kSuccessRate) {
    for (const auto& [before, after] : pairs) {
      values.push_back({.map = before->map,
                        .before = finished(*before) ? 1.0 : 0.0,
                        .after = finished(*after) ? 1.0 : 0.0});
    }
    return values;
  }
  const auto [base_column, new_column] = common_metric(base, now, metric);
  const bool takes_failures = contains(kOfFailuresToo, metric);
  for (const auto& [before, after] : pairs) {
    // Both have to have finished: else a planner that fails on hard missions would improve by it.
    if (!takes_failures && !(finished(*before) && finished(*after))) continue;
    // Not measured in one of the two: a pair needs both.
    const double old_value = before->metrics[base_column], new_value = after->metrics[new_column];
    if (!std::isfinite(old_value) || !std::isfinite(new_value)) continue;
    values.push_back({.map = before->map, .before = old_value, .after = new_value});
  }
  return values;
}

/// v90 over the pairs on either side, and its change by draws of maps, the same for both. p takes
/// the change over the draws' spread as Student's t of the maps; NaN for fewer than kLeastMaps.
void fill_v90_figures(const TrialTable& base, const TrialTable& now,
                      const std::vector<TrialPair>& pairs, std::size_t replicate_count,
                      MetricComparison& row) {
  const auto [base_column, new_column] = common_metric(base, now, kGoalVelocity);
  std::map<std::uint64_t, std::size_t> maps;
  for (const TrialPair& pair : pairs) maps.emplace(pair.before->map, 0);
  std::size_t map_count = 0;
  // In order of the maps' digests, as sums_by_map().
  for (auto& [digest, number] : maps) number = map_count++;
  std::vector<SpeedTrial> before, after;
  for (const auto& [old_trial, new_trial] : pairs) {
    const std::size_t map = maps.at(old_trial->map);
    before.push_back({map, finished(*old_trial) ? old_trial->metrics[base_column] : 0.0});
    after.push_back({map, finished(*new_trial) ? new_trial->metrics[new_column] : 0.0});
  }
  row.pair_count = static_cast<std::int64_t>(pairs.size());
  row.adjusted_p = kNaN;
  const std::vector<SpeedStep> curve = speed_curve(after);
  row.base_mean = reached_speed(speed_curve(before), kReachedShare);
  row.new_mean = reached_speed(curve, kReachedShare);
  row.new_interval = reached_speed_interval(curve, kReachedShare);
  const std::vector<double> old_draws =
      reached_speed_draws(before, map_count, kReachedShare, replicate_count);
  const std::vector<double> new_draws =
      reached_speed_draws(after, map_count, kReachedShare, replicate_count);
  const SpeedDifference difference =
      speed_difference(row.new_mean, row.base_mean, new_draws, old_draws, map_count);
  row.change = difference.difference_mps;
  row.change_interval = difference.interval;
  row.p = difference.p;
}

/// The row without its verdict, which judge() gives when all rows are there.
MetricComparison row_of(const TrialTable& base, const TrialTable& now,
                        const std::vector<TrialPair>& pairs, std::size_t planner,
                        const std::string& metric, std::size_t replicate_count) {
  MetricComparison row;
  row.planner = planner;
  row.metric = metric;
  row.better = Better::more;
  if (metric == kV90) {
    row.unit = "m/s";
    fill_v90_figures(base, now, pairs, replicate_count, row);
    return row;
  }
  if (metric != kSuccessRate) {
    const MetricRow& definition = now.metrics[common_metric(base, now, metric).second];
    row.unit = definition.unit;
    row.better = definition.better;
    row.is_measured = definition.is_measured;
  }
  fill_figures(values_of(base, now, pairs, metric), replicate_count, row);
  return row;
}

/// Corrects the p of what may fail the comparison, and judges.
/// Two limits: beyond chance (p) and beyond the tolerance. Only metrics that may fail the
/// comparison are tests; those that may not don't make it harder for the others.
void judge(const CompareSettings& settings, Comparison& comparison) {
  std::vector<double> p;
  std::vector<std::size_t> gated;
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    MetricComparison& row = comparison.rows[i];
    const auto own = settings.tolerances.find(row.metric);
    const Tolerance& tolerance =
        own == settings.tolerances.end() ? settings.tolerance : own->second;
    const bool is_share = tolerance.kind == Tolerance::Kind::relative;
    row.limit = tolerance.value * (is_share ? std::abs(row.base_mean) : 1.0);
    const bool is_gated = tolerance.kind != Tolerance::Kind::ignored &&
                          row.better != Better::neither && !std::isnan(row.p) &&
                          (!row.is_measured || settings.gates_measured);
    row.verdict = Verdict::not_gated;
    if (!is_gated) continue;
    gated.push_back(i);
    p.push_back(row.p);
  }
  // Over all planners and metrics at once: alpha is of the whole comparison.
  const std::vector<double> adjusted = holm_adjusted(p);
  comparison.test_count = static_cast<std::int64_t>(gated.size());
  for (std::size_t i = 0; i < gated.size(); ++i) {
    MetricComparison& row = comparison.rows[gated[i]];
    row.adjusted_p = adjusted[i];
    // A rank test may find a shift where the means agree: no change, no verdict.
    const bool is_sure = row.adjusted_p < settings.alpha && row.change != 0.0;
    // A tolerance of 0 means any change, but not none.
    const bool is_large = std::abs(row.change) > 0.0 && std::abs(row.change) >= row.limit;
    const bool is_worse = (row.better == Better::less) == (row.change > 0.0);
    row.verdict = Verdict::same;
    if (is_large) row.verdict = Verdict::unclear;
    if (is_sure) row.verdict = Verdict::small;
    if (is_sure && is_large) row.verdict = is_worse ? Verdict::regression : Verdict::improvement;
  }
}

/// The success rate is always first, then v90 where both sides have goal velocities. `finished` is
/// the success rate in other words, and would be tested twice.
std::vector<std::string> wanted_metrics(const TrialTable& base, const TrialTable& now,
                                        const CompareSettings& settings) {
  std::vector<std::string> names{std::string(kSuccessRate)};
  if (has_metric(base, kGoalVelocity) && has_metric(now, kGoalVelocity)) names.emplace_back(kV90);
  if (settings.metrics == std::vector<std::string>{"all"}) {
    for (const MetricRow& metric : now.metrics) {
      // What only one side has can't be paired; a metric that was asked for by name is an error
      // there.
      if (metric.name != "finished" && has_metric(base, metric.name)) names.push_back(metric.name);
    }
  } else if (settings.metrics.empty()) {
    for (const std::string_view name : kUsualMetrics) {
      if (has_metric(base, name) && has_metric(now, name)) names.emplace_back(name);
    }
  } else {
    for (const std::string& name : settings.metrics) {
      if (name != "finished" && !contains(names, name)) names.push_back(name);
    }
  }
  return names;
}

/// Counts trials that one side lacks, and says so.
void tell_unpaired(Comparison& comparison) {
  for (const PlannerPairs& planner : comparison.planners) {
    std::vector<std::string> gaps;
    if (planner.only_base_count > 0) {
      gaps.push_back(counted(planner.only_base_count, "trial") + " only in the base");
    }
    if (planner.only_new_count > 0) {
      gaps.push_back(counted(planner.only_new_count, "trial") + " only in the new results");
    }
    if (gaps.empty()) continue;
    comparison.warnings.push_back(
        planner.planner + ": " + joined(gaps) +
        (planner.pair_count == 0 ? "; none is compared" : "; these are not compared"));
  }
}

/// Says where so few missions are paired that not even losing them all could be told from chance.
void tell_few_pairs(Comparison& comparison) {
  std::string few;
  for (const PlannerPairs& planner : comparison.planners) {
    // All of them lost, against Holm's strictest step: the smallest p of all `tests`.
    const double least_p = mcnemar_exact_p(planner.pair_count, 0);
    const auto tests = static_cast<double>(comparison.test_count);
    if (planner.pair_count == 0 || least_p * tests < comparison.alpha) continue;
    few += (few.empty() ? "" : ", ") + planner.planner;
  }
  if (few.empty()) return;
  comparison.warnings.push_back("too few trials of " + few +
                                " to distinguish a regression from chance: fly more missions, "
                                "or compare bit for bit");
}

/// Of the pairs of one planner: how often each cause stands on either side. Nothing where a failure
/// has none: a table of half the failures would say which were looked at.
std::vector<CauseChange> cause_changes(const std::string& planner,
                                       const std::vector<TrialPair>& pairs) {
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> only;  // base only, new only
  std::map<std::string, CauseChange> changes;
  for (const auto& [before, after] : pairs) {
    if (finished(*before) != before->cause.empty() || finished(*after) != after->cause.empty()) {
      return {};
    }
    if (!before->cause.empty()) ++changes[before->cause].base_count;
    if (!after->cause.empty()) ++changes[after->cause].new_count;
    if (before->cause == after->cause) continue;
    ++only[before->cause].first;
    ++only[after->cause].second;
  }
  std::vector<CauseChange> found;
  for (auto& [cause, change] : changes) {
    change.planner = planner;
    change.cause = cause;
    change.pair_count = static_cast<std::int64_t>(pairs.size());
    change.p = mcnemar_exact_p(only[cause].first, only[cause].second);
    found.push_back(change);
  }
  std::stable_sort(found.begin(), found.end(), [](const CauseChange& a, const CauseChange& b) {
    return a.new_count - a.base_count > b.new_count - b.base_count;
  });
  return found;
}

void tell_other_missions(std::int64_t others, std::int64_t pair_count, Comparison& comparison) {
  if (others == 0) return;
  comparison.warnings.push_back(
      counted(others, "pair") + " of " + std::to_string(pair_count) +
      " flew in another world or between other places: generator, missions or their seed changed, "
      "and the pairing says less");
}

}  // namespace

/// Both tables are in order of identities, which no two trials of one share: one walk finds all
/// pairs.
std::vector<TrialPair> paired_trials(const TrialTable& base, const TrialTable& now) {
  std::vector<TrialPair> pairs;
  for (std::size_t i = 0, k = 0; i < base.trials.size() || k < now.trials.size();) {
    TrialPair& pair = pairs.emplace_back();
    if (i < base.trials.size()) pair.before = &base.trials[i];
    if (k < now.trials.size()) pair.after = &now.trials[k];
    // The one that comes first stands alone.
    if (pair.is_whole() && pair.before->identity < pair.after->identity) pair.after = nullptr;
    if (pair.is_whole() && pair.after->identity < pair.before->identity) pair.before = nullptr;
    i += pair.before != nullptr ? 1U : 0U;
    k += pair.after != nullptr ? 1U : 0U;
  }
  return pairs;
}

bool has_metric(const TrialTable& table, std::string_view name) {
  return place_in(table.metrics, name, &MetricRow::name).has_value();
}

std::pair<std::size_t, std::size_t> common_metric(const TrialTable& base, const TrialTable& now,
                                                  const std::string& name) {
  const auto position = [&](const TrialTable& table) {
    if (const auto place = place_in(table.metrics, name, &MetricRow::name)) return *place;
    std::vector<std::string> names;
    for (const MetricRow& metric : table.metrics) names.push_back(metric.name);
    refuse_file(table.source, "has no metric " + name + did_you_mean(name, names));
  };
  const std::pair columns{position(base), position(now)};
  // A version stands for a formula: two of them are two metrics of one name.
  const int before = base.metrics[columns.first].version;
  const int after = now.metrics[columns.second].version;
  if (before != after) {
    throw InputError(name + " is defined in version " + std::to_string(before) + " in " +
                     base.source + " and in version " + std::to_string(after) + " in " +
                     now.source + ": values of the two can't be compared; make the base again");
  }
  return columns;
}

std::int64_t count_of(const Comparison& comparison, Verdict verdict) {
  return std::count_if(comparison.rows.begin(), comparison.rows.end(),
                       [&](const MetricComparison& row) { return row.verdict == verdict; });
}

Comparison compare_tables(const TrialTable& base, const TrialTable& now,
                          const CompareSettings& settings) {
  Comparison comparison;
  comparison.base = base.source;
  comparison.now = now.source;
  comparison.base_sweep = base.sweep;
  comparison.new_sweep = now.sweep;
  comparison.alpha = settings.alpha;
  const std::vector<std::string> metrics = wanted_metrics(base, now, settings);
  // Unknown names and versions fail here, before anything is computed.
  for (const std::string& name : metrics) {
    if (name != kSuccessRate && name != kV90) common_metric(base, now, name);
  }

  std::map<std::string, PlannerPairs> counts;
  std::map<std::string, std::vector<TrialPair>> trials;
  std::int64_t pair_count = 0, other_missions = 0;
  for (const TrialPair& pair : paired_trials(base, now)) {
    const auto& [before, after] = pair;
    PlannerPairs& count = counts[pair.identity().planner];
    count.only_base_count += after == nullptr ? 1 : 0;
    count.only_new_count += before == nullptr ? 1 : 0;
    if (!pair.is_whole()) continue;
    ++pair_count;
    other_missions += before->mission != after->mission ? 1 : 0;
    ++count.pair_count;
    count.lost_count += finished(*before) && !finished(*after) ? 1 : 0;
    count.gained_count += finished(*after) && !finished(*before) ? 1 : 0;
    trials[pair.identity().planner].push_back(pair);
    if (before->outcome == after->outcome) continue;
    comparison.flips.push_back(
        {.identity = pair.identity(), .before = before->outcome, .after = after->outcome});
  }
  if (pair_count == 0) {
    throw InputError("no trial of " + base.source + " is in " + now.source +
                     ": planner labels, maps, missions or axes differ");
  }
  // What is lost first, then what is won, then what failed in another way.
  const auto rank = [](const Flip& flip) {
    if (flip.before == Outcome::reached_goal) return 0;
    return flip.after == Outcome::reached_goal ? 1 : 2;
  };
  // Stable: within a kind of flip they stay in order of identities.
  std::stable_sort(comparison.flips.begin(), comparison.flips.end(),
                   [&](const Flip& a, const Flip& b) { return rank(a) < rank(b); });
  for (auto& [planner, count] : counts) {
    count.planner = planner;
    comparison.planners.push_back(count);
    if (count.pair_count == 0) continue;
    for (CauseChange& change : cause_changes(planner, trials[planner])) {
      comparison.causes.push_back(std::move(change));
    }
    for (const std::string& metric : metrics) {
      // Fewer say nothing of nine missions of ten.
      if (metric == kV90 && count.pair_count < least_trials_for(kReachedShare)) continue;
      comparison.rows.push_back(row_of(base, now, trials[planner], comparison.planners.size() - 1,
                                       metric, settings.replicate_count));
    }
  }
  judge(settings, comparison);
  tell_unpaired(comparison);
  tell_few_pairs(comparison);
  tell_other_missions(other_missions, pair_count, comparison);
  return comparison;
}

}  // namespace avoidbench
