#include "report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/input_error.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/ranks.hpp"
#include "statistics/rates.hpp"
#include "statistics/sample_size.hpp"

namespace avoidbench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kAlpha = 0.05;
constexpr std::size_t kGroupCount = 5;
constexpr std::int64_t kFewTrials = 10;

using Mission = std::pair<std::string, std::int64_t>;  // map key, index
using Trials = std::vector<const TrialSummary*>;

std::vector<std::string> unique_labels(const std::vector<PlannerRow>& planners) {
  std::vector<std::string> labels;
  for (const PlannerRow& planner : planners) {
    const auto count =
        std::count_if(planners.begin(), planners.end(),
                      [&](const PlannerRow& other) { return other.label == planner.label; });
    labels.push_back(count == 1 ? planner.label
                                : planner.label + "@" + planner_key(planner).substr(0, 6));
  }
  return labels;
}

std::vector<std::size_t> metric_indices(const SweepResult& result,
                                        std::span<const std::string> names) {
  std::vector<std::string> known;
  for (const MetricRow& metric : result.metrics) known.push_back(metric.name);
  std::vector<std::size_t> indices;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      throw InputError("no metric " + name + " in the results" + did_you_mean(name, known));
    }
    indices.push_back(static_cast<std::size_t>(found - known.begin()));
  }
  return indices;
}

MetricMean mean_of(const Trials& trials, std::size_t metric) {
  MetricMean result;
  double sum = 0.0;
  for (const TrialSummary* trial : trials) {
    if (std::isnan(trial->metrics[metric])) continue;
    sum += trial->metrics[metric];
    ++result.count;
  }
  const auto count = static_cast<double>(result.count);
  result.mean = result.count > 0 ? sum / count : kNaN;
  double squares = 0.0;
  for (const TrialSummary* trial : trials) {
    const double deviation = trial->metrics[metric] - result.mean;
    if (!std::isnan(deviation)) squares += deviation * deviation;
  }
  result.standard_deviation = result.count > 1 ? std::sqrt(squares / (count - 1.0)) : kNaN;
  return result;
}

PlannerSummary summary_of(std::size_t planner, const Trials& trials,
                          std::span<const std::size_t> metrics) {
  PlannerSummary summary;
  summary.planner = planner;
  summary.trial_count = static_cast<std::int64_t>(trials.size());
  double length_m = 0.0;
  for (const TrialSummary* trial : trials) {
    summary.outcome_counts[static_cast<std::size_t>(trial->outcome)] += 1;
    length_m += trial->reference_length_m;
  }
  summary.finished_count = summary.outcome_counts[static_cast<std::size_t>(Outcome::reached_goal)];
  const auto count = static_cast<double>(trials.size());
  summary.success_rate = static_cast<double>(summary.finished_count) / count;  // 0 / 0 is NaN
  summary.success_interval = wilson_interval(summary.finished_count, summary.trial_count);
  summary.mean_reference_length_m = length_m / count;
  for (const std::size_t metric : metrics) summary.means.push_back(mean_of(trials, metric));
  return summary;
}

/// The metric's value on each mission, mean where the mission was flown more than once.
std::map<Mission, double> values_by_mission(const Trials& trials, std::size_t metric) {
  std::map<Mission, std::pair<double, double>> sums;
  for (const TrialSummary* trial : trials) {
    if (std::isnan(trial->metrics[metric])) continue;
    auto& [sum, count] = sums[{trial->map_key, trial->mission_index}];
    sum += trial->metrics[metric];
    count += 1.0;
  }
  std::map<Mission, double> values;
  for (const auto& [mission, sum] : sums) values.emplace(mission, sum.first / sum.second);
  return values;
}

void mark_best_rate(std::vector<PlannerSummary>& planners) {
  const auto best =
      std::max_element(planners.begin(), planners.end(), [](const auto& a, const auto& b) {
        return a.success_rate < b.success_rate ||
               (std::isnan(a.success_rate) && !std::isnan(b.success_rate));
      });
  const auto comparisons = static_cast<double>(planners.size() - 1);  // Bonferroni
  best->is_best_rate =
      std::all_of(planners.begin(), planners.end(), [&](const PlannerSummary& other) {
        if (other.planner == best->planner) return true;
        return best->success_rate > other.success_rate &&
               comparisons * fisher_exact_p(best->finished_count, best->trial_count,
                                            other.finished_count, other.trial_count) <
                   kAlpha;
      });
}

/// Marks the best mean of metric `column`, where it is significantly better on the missions that
/// both planners have.
void mark_best_mean(std::vector<PlannerSummary>& planners, const std::vector<Trials>& trials,
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
  const std::map<Mission, double> values = values_by_mission(trials[best], metric);
  for (std::size_t i = 0; i < planners.size(); ++i) {
    if (i == best) continue;
    std::vector<double> differences;
    for (const auto& [mission, other] : values_by_mission(trials[i], metric)) {
      const auto paired = values.find(mission);
      if (paired != values.end()) differences.push_back(sign * (paired->second - other));
    }
    const RankTest test = wilcoxon_signed_rank(differences);
    if (test.z <= 0.0 || comparisons * test.p >= kAlpha) return;  // Bonferroni
  }
  planners[best].means[column].is_best = true;
}

std::vector<PlannerSummary> summaries(const std::vector<Trials>& by_planner,
                                      std::span<const std::size_t> indices,
                                      std::span<const MetricRow> metrics) {
  std::vector<PlannerSummary> planners;
  for (std::size_t i = 0; i < by_planner.size(); ++i) {
    planners.push_back(summary_of(i, by_planner[i], indices));
  }
  if (planners.size() > 1) {
    mark_best_rate(planners);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      mark_best_mean(planners, by_planner, i, indices[i], metrics[i].better);
    }
  }
  return planners;
}

/// Maps with trials, the least traversable first, in up to kGroupCount groups of equal count (±1).
std::vector<std::vector<const MapRow*>> map_groups(const SweepResult& result) {
  std::set<std::string> flown;
  for (const TrialSummary& trial : result.trials) flown.insert(trial.map_key);
  std::vector<const MapRow*> maps;
  for (const MapRow& map : result.maps) {
    const bool is_measured = !std::isnan(map.record.traversability_normalized_ratio);
    if (is_measured && flown.contains(map.record.key)) maps.push_back(&map);
  }
  std::sort(maps.begin(), maps.end(), [](const MapRow* a, const MapRow* b) {
    return std::pair(a->record.traversability_normalized_ratio, a->record.key) <
           std::pair(b->record.traversability_normalized_ratio, b->record.key);
  });
  const std::size_t count = std::min(kGroupCount, maps.size());
  std::vector<std::vector<const MapRow*>> groups(count);
  for (std::size_t i = 0; i < maps.size(); ++i) groups[i * count / maps.size()].push_back(maps[i]);
  return groups;
}

Contrast contrast_of(const SweepSummary& summary, const std::vector<Trials>& by_planner,
                     std::size_t one, std::size_t two) {
  const PlannerSummary& a = summary.overall[one];
  const PlannerSummary& b = summary.overall[two];
  Contrast contrast;
  contrast.planner_1 = one;
  contrast.planner_2 = two;
  contrast.factor = contrast_factor(a.success_rate, a.mean_reference_length_m, b.success_rate,
                                    b.mean_reference_length_m);
  contrast.fisher_p =
      fisher_exact_p(a.finished_count, a.trial_count, b.finished_count, b.trial_count);

  // Sums of each map, which is what a draw of maps needs.
  struct Sums {
    std::array<std::int64_t, 2> trials{}, finished{};
    std::array<double, 2> length_m{};
  };
  std::map<std::string, Sums> by_map;
  for (const std::size_t side : {0U, 1U}) {
    for (const TrialSummary* trial : by_planner[side == 0 ? one : two]) {
      Sums& sums = by_map[trial->map_key];
      sums.trials[side] += 1;
      sums.finished[side] += trial->outcome == Outcome::reached_goal ? 1 : 0;
      sums.length_m[side] += trial->reference_length_m;
    }
  }
  std::vector<Sums> maps;
  for (const auto& [key, sums] : by_map) maps.push_back(sums);
  const auto smoothed = [&](std::span<const std::size_t> drawn) {
    Sums all;
    for (const std::size_t map : drawn) {
      for (const std::size_t side : {0U, 1U}) {
        all.trials[side] += maps[map].trials[side];
        all.finished[side] += maps[map].finished[side];
        all.length_m[side] += maps[map].length_m[side];
      }
    }
    if (all.trials[0] == 0 || all.trials[1] == 0) return kNaN;
    return contrast_factor(jeffreys_rate(all.finished[0], all.trials[0]),
                           all.length_m[0] / static_cast<double>(all.trials[0]),
                           jeffreys_rate(all.finished[1], all.trials[1]),
                           all.length_m[1] / static_cast<double>(all.trials[1]));
  };
  std::vector<std::size_t> every(maps.size());
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = i;
  contrast.smoothed_factor = smoothed(every);
  contrast.smoothed_interval = bca_interval(maps.size(), smoothed, stream(1, "contrast_factor"));
  return contrast;
}

std::string rounded(double value, int decimals) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  return buffer.data();
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : std::string(separator)) + word;
  return line;
}

void warn_of_few_trials(SweepSummary& summary) {
  std::vector<std::string> few;
  for (const PlannerSummary& planner : summary.overall) {
    if (planner.trial_count < kFewTrials) few.push_back(summary.planners[planner.planner]);
  }
  if (!few.empty()) {
    summary.warnings.push_back("fewer than 10 trials of " + joined(few, ", ") +
                               ": hardly more than anecdotes");
  }
  std::int64_t few_cells = 0, cells = 0;
  for (const MapGroup& group : summary.groups) {
    for (const PlannerSummary& planner : group.planners) {
      few_cells += planner.trial_count < kFewTrials ? 1 : 0;
      ++cells;
    }
  }
  if (few_cells > 0) {
    summary.warnings.push_back("fewer than 10 trials in " + std::to_string(few_cells) + " of " +
                               std::to_string(cells) + " cells of planner and map group");
  }
}

void warn_of_unclear_differences(SweepSummary& summary) {
  std::vector<std::string> unclear;
  for (const Contrast& contrast : summary.contrasts) {
    if (contrast.fisher_p < kAlpha) continue;
    const PlannerSummary& a = summary.overall[contrast.planner_1];
    const PlannerSummary& b = summary.overall[contrast.planner_2];
    std::string pair =
        summary.planners[contrast.planner_1] + " / " + summary.planners[contrast.planner_2];
    if (a.success_rate != b.success_rate) {
      const double trials = std::ceil(two_rates_trials(a.success_rate, b.success_rate));
      pair += " (would take some " + rounded(trials, 0) + " trials each)";
    }
    unclear.push_back(pair);
  }
  if (!unclear.empty()) {
    summary.warnings.push_back("success rates that can't be told apart: " + joined(unclear, ", "));
  }
}

void warn_of_mixtures(SweepSummary& summary, const SweepResult& result) {
  if (result.program_versions.size() > 1) {
    summary.warnings.push_back("trials of different versions of avoidbench: " +
                               joined(result.program_versions, ", "));
  }
  std::map<std::string, std::string> key_of_label;
  for (const PlannerRow& planner : result.planners) {
    if (!key_of_label.emplace(planner.label, planner_key(planner)).second) {
      summary.warnings.push_back("planners of different files or parameters share the label " +
                                 planner.label);
    }
  }
  std::set<std::pair<std::string, Mission>> flights;
  for (const TrialSummary& trial : result.trials) {
    if (!flights.insert({trial.planner_key, {trial.map_key, trial.mission_index}}).second) {
      summary.warnings.push_back(
          "trials differ in more than planner, map and mission; this report takes them together");
      break;
    }
  }
}

}  // namespace

std::vector<std::string> default_metrics(const SweepResult& result) {
  std::vector<std::string> names;
  for (const std::string_view name :
       {"path_optimality_pct", "energy_optimality", "average_goal_velocity_mps",
        "mission_progress_pct", "processing_time_ms"}) {
    for (const MetricRow& metric : result.metrics) {
      if (metric.name == name) names.emplace_back(name);
    }
  }
  return names;
}

SweepSummary summarize(const SweepResult& result, std::span<const std::string> metric_names) {
  SweepSummary summary;
  summary.name = result.name;
  summary.revision = result.revision;
  const std::vector<std::size_t> indices = metric_indices(result, metric_names);
  for (const std::size_t index : indices) summary.metrics.push_back(result.metrics[index]);
  summary.planners = unique_labels(result.planners);
  summary.map_count = static_cast<std::int64_t>(result.maps.size());
  summary.trial_count = static_cast<std::int64_t>(result.trials.size());
  for (const MapRow& map : result.maps) {
    summary.mission_count += static_cast<std::int64_t>(map.record.missions.size());
    for (const MissionRecord& mission : map.record.missions) {
      summary.invalid_mission_count += mission.is_valid ? 0 : 1;
    }
  }

  std::map<std::string, std::size_t> planner_indices;
  for (std::size_t i = 0; i < result.planners.size(); ++i) {
    planner_indices.emplace(planner_key(result.planners[i]), i);
  }
  std::vector<Trials> by_planner(result.planners.size());
  for (const TrialSummary& trial : result.trials) {
    by_planner[planner_indices.at(trial.planner_key)].push_back(&trial);
  }
  summary.overall = summaries(by_planner, indices, summary.metrics);

  const auto groups = map_groups(result);
  for (const std::vector<const MapRow*>& maps : groups) {
    if (groups.size() < 2) break;
    std::set<std::string> keys;
    for (const MapRow* map : maps) keys.insert(map->record.key);
    std::vector<Trials> grouped(by_planner.size());
    for (std::size_t i = 0; i < by_planner.size(); ++i) {
      for (const TrialSummary* trial : by_planner[i]) {
        if (keys.contains(trial->map_key)) grouped[i].push_back(trial);
      }
    }
    summary.groups.push_back({.map_count = static_cast<std::int64_t>(maps.size()),
                              .lowest_ratio = maps.front()->record.traversability_normalized_ratio,
                              .highest_ratio = maps.back()->record.traversability_normalized_ratio,
                              .planners = summaries(grouped, indices, summary.metrics)});
  }

  for (std::size_t one = 0; one < by_planner.size(); ++one) {
    for (std::size_t two = one + 1; two < by_planner.size(); ++two) {
      summary.contrasts.push_back(contrast_of(summary, by_planner, one, two));
    }
  }
  warn_of_few_trials(summary);
  warn_of_unclear_differences(summary);
  warn_of_mixtures(summary, result);
  return summary;
}

SweepResult combined(std::span<const SweepResult> parts) {
  SweepResult all = parts.front();
  std::map<std::string, PlannerRow> planners;
  std::map<std::string, MapRow> maps;
  std::map<std::string, TrialSummary> trials;
  std::set<std::string> versions;
  for (const SweepResult& part : parts) {
    const bool same_metrics = std::equal(
        part.metrics.begin(), part.metrics.end(), all.metrics.begin(), all.metrics.end(),
        [](const auto& a, const auto& b) { return a.name == b.name && a.version == b.version; });
    if (!same_metrics) {
      throw InputError("the databases of sweep " + all.name +
                       " define their metrics differently: report them one by one");
    }
    for (const PlannerRow& row : part.planners)
      planners.emplace(row.label + '\0' + planner_key(row), row);
    for (const TrialSummary& row : part.trials) trials.emplace(row.key, row);
    versions.insert(part.program_versions.begin(), part.program_versions.end());
    for (const MapRow& row : part.maps) {
      const auto [entry, is_new] = maps.emplace(row.record.key, row);
      if (is_new) continue;
      std::vector<MissionRecord>& missions = entry->second.record.missions;
      for (const MissionRecord& mission : row.record.missions) {
        const bool is_there =
            std::any_of(missions.begin(), missions.end(),
                        [&](const MissionRecord& other) { return other.index == mission.index; });
        if (!is_there) missions.push_back(mission);
      }
    }
  }
  all.planners.clear();
  all.maps.clear();
  all.trials.clear();
  for (const auto& [key, row] : planners) all.planners.push_back(row);
  for (const auto& [key, row] : maps) all.maps.push_back(row);
  for (const auto& [key, row] : trials) all.trials.push_back(row);
  all.program_versions.assign(versions.begin(), versions.end());
  return all;
}

}  // namespace avoidbench
