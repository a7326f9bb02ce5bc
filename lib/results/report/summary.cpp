#include "report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/input_error.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kGroupCount = 5;
constexpr std::string_view kPlanner = "planner";

/// Labels, with the beginning of the key behind those that two planners share.
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

/// Of the sweep's planners that are told of movers; none where its spec can't be read.
std::set<std::string> labels_with_tracks(const std::string& spec_json) {
  std::set<std::string> labels;
  const nlohmann::json spec = nlohmann::json::parse(spec_json, nullptr, false);
  if (!spec.is_object()) return labels;
  for (const nlohmann::json& planner : spec.value("planners", nlohmann::json::array())) {
    if (planner.value("sees_tracks", false)) labels.insert(planner.value("label", ""));
  }
  return labels;
}

std::vector<std::size_t> metric_indices(const SweepResult& result,
                                        std::span<const std::string> names) {
  std::vector<std::string> known;
  for (const MetricRow& metric : result.metrics) known.push_back(metric.name);
  std::vector<std::size_t> indices;
  for (const std::string& name : names) {
    const auto place = place_in(known, name);
    if (!place) {
      throw InputError("no metric " + name + " in the results" + did_you_mean(name, known));
    }
    indices.push_back(*place);
  }
  return indices;
}

/// Trials with their maps, in order.
Trials trials_on_maps(const SweepResult& result) {
  std::map<std::string_view, std::size_t> indices;
  for (std::size_t i = 0; i < result.maps.size(); ++i) {
    indices.emplace(result.maps[i].record.key, i);
  }
  Trials trials;
  trials.reserve(result.trials.size());
  for (const TrialSummary& trial : result.trials) {
    trials.push_back({.trial = &trial, .map = indices.at(trial.map_key)});
  }
  // The order that sums, runs of maps and pairing rely on. The key makes it the same for several
  // trials of a mission, whatever the order of flying.
  std::sort(trials.begin(), trials.end(), [](const TrialOnMap& a, const TrialOnMap& b) {
    return std::tie(a.map, a.trial->mission_index, a.trial->key) <
           std::tie(b.map, b.trial->mission_index, b.trial->key);
  });
  return trials;
}

/// Of every planner of the result, its trials among these.
std::vector<Trials> by_planner(const SweepResult& result, const Trials& trials) {
  std::map<std::string, std::size_t, std::less<>> indices;
  for (std::size_t i = 0; i < result.planners.size(); ++i) {
    indices.emplace(planner_key(result.planners[i]), i);
  }
  std::vector<Trials> planners(result.planners.size());
  for (const TrialOnMap& on_map : trials) {
    planners[indices.at(on_map.trial->planner_key)].push_back(on_map);
  }
  return planners;
}

/// The summaries of all planners of the result over these trials.
std::vector<PlannerSummary> summaries(const SweepResult& result, const Trials& trials,
                                      std::span<const std::size_t> metrics) {
  const std::vector<Trials> planners = by_planner(result, trials);
  std::vector<PlannerSummary> summaries;
  for (std::size_t i = 0; i < planners.size(); ++i) {
    summaries.push_back(planner_summary(i, planners[i], metrics));
  }
  mark_best(summaries, planners, metrics, result.metrics);
  return summaries;
}

/// Maps with trials, the least traversable first, in up to kGroupCount groups of equal count (±1).
std::vector<MapGroup> groups_of(const SweepResult& result, const Trials& trials,
                                std::span<const std::size_t> metrics) {
  std::vector<std::pair<double, std::size_t>> maps;
  for (const MapCount& count : counts_by_map(trials)) {
    const double ratio = result.maps[count.map].record.traversability_normalized_ratio;
    if (!std::isnan(ratio)) maps.emplace_back(ratio, count.map);
  }
  std::sort(maps.begin(), maps.end());
  const std::size_t group_count = std::min(kGroupCount, maps.size());
  // One group is the whole table again.
  if (group_count < 2) return {};
  std::vector<MapGroup> groups(group_count);
  std::map<std::size_t, std::size_t> place_of_map;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto [ratio, map] = maps[i];
    // In whole numbers: groups differ by one map at most.
    const std::size_t place = i * group_count / maps.size();
    place_of_map[map] = place;
    MapGroup& group = groups[place];
    if (group.map_count++ == 0) group.lowest_ratio = ratio;
    group.highest_ratio = ratio;
  }
  std::vector<Trials> grouped(group_count);
  for (const TrialOnMap& on_map : trials) {
    const auto place = place_of_map.find(on_map.map);
    if (place != place_of_map.end()) grouped[place->second].push_back(on_map);
  }
  for (std::size_t i = 0; i < group_count; ++i) {
    groups[i].planners = summaries(result, grouped[i], metrics);
  }
  return groups;
}

std::int64_t map_count_of(const Trials& trials) {
  return static_cast<std::int64_t>(counts_by_map(trials).size());
}

/// Marks what is best among rows that have the same keys but for the planner.
void mark_best_rows(std::vector<GroupRow>& rows, const std::vector<Trials>& trials,
                    std::size_t planner_column, std::span<const std::size_t> metrics,
                    std::span<const MetricRow> definitions) {
  // Rows that differ in the planner only: they have flown the same.
  std::map<std::vector<TableValue>, std::vector<std::size_t>> rivals;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<TableValue> keys = rows[i].keys;
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(planner_column));
    rivals[keys].push_back(i);
  }
  for (const auto& [keys, indices] : rivals) {
    std::vector<PlannerSummary> summaries;
    std::vector<Trials> of_rivals;
    for (const std::size_t i : indices) {
      summaries.push_back(rows[i].summary);
      of_rivals.push_back(trials[i]);
    }
    mark_best(summaries, of_rivals, metrics, definitions);
    for (std::size_t k = 0; k < indices.size(); ++k) rows[indices[k]].summary = summaries[k];
  }
}

std::vector<GroupRow> group_rows(const SweepResult& result, const Trials& trials,
                                 const std::vector<GroupColumn>& columns,
                                 std::span<const std::size_t> metrics) {
  std::vector<GroupRow> rows;
  std::vector<Trials> of_rows;
  for (GroupedTrials& group : group_trials(result, trials, columns)) {
    rows.push_back({.keys = std::move(group.keys),
                    .map_count = map_count_of(group.trials),
                    .summary = planner_summary(0, group.trials, metrics)});
    of_rows.push_back(std::move(group.trials));
  }
  if (const auto planner = place_in(columns, kPlanner, &GroupColumn::field)) {
    mark_best_rows(rows, of_rows, *planner, metrics, result.metrics);
  }
  return rows;
}

/// Planners' labels in the trials' field `planner` as they are shown: none stands for two planners.
void name_planners(SweepResult& result, const std::vector<std::string>& labels) {
  const auto field = place_in(result.fields, kPlanner);
  // Fields are read where a condition or a group asks for them.
  if (!field) return;
  std::map<std::string, std::string> label_of_key;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    label_of_key.emplace(planner_key(result.planners[i]), labels[i]);
  }
  for (TrialSummary& trial : result.trials) {
    trial.fields[*field] = label_of_key.at(trial.planner_key);
  }
}

void add_pairs_and_curves(SweepSummary& summary, const SweepResult& result,
                          const std::vector<Trials>& planners) {
  for (std::size_t one = 0; one < planners.size(); ++one) {
    // Each pair once: the factor the other way round is its inverse.
    for (std::size_t two = one + 1; two < planners.size(); ++two) {
      summary.contrasts.push_back(
          contrast_of(summary.overall[one], planners[one], summary.overall[two], planners[two]));
      summary.contrasts.back().v90 =
          v90_difference(summary.speeds[one], summary.speeds[two], result.maps.size());
    }
    summary.flight_times.push_back(flight_times(one, planners[one]));
    if (map_count_of(planners[one]) >= static_cast<std::int64_t>(kLeastMaps)) {
      summary.difficulty.push_back(difficulty_response(one, planners[one], result.maps));
    }
  }
}

}  // namespace

void add_limit_field(const std::string& spec_json, std::vector<std::string>& fields) {
  const auto rule = limit_rule_of(spec_json);
  if (rule && !contains(fields, rule->field)) fields.push_back(rule->field);
}

std::vector<std::string> ReportQuery::fields() const {
  std::vector<std::string> fields;
  const auto add = [&](const std::string& field) {
    // Each once, in the order asked for.
    if (!contains(fields, field)) fields.push_back(field);
  };
  for (const GroupColumn& column : group_by) add(column.field);
  for (const Condition& condition : where) add(condition.field);
  return fields;
}

/// AvoidBench's own, and the wall time: CPU time does not show what a planner waits for.
std::vector<std::string> default_metrics(const SweepResult& result) {
  std::vector<std::string> names;
  for (const std::string_view name :
       // A database of before a metric lacks it.
       {"path_optimality_pct", "energy_optimality", "average_goal_velocity_mps",
        "mission_progress_pct", "processing_time_ms", "processing_wall_time_ms"}) {
    for (const MetricRow& metric : result.metrics) {
      if (metric.name == name) names.emplace_back(name);
    }
  }
  return names;
}

SweepSummary summarize(SweepResult result, const ReportQuery& query) {
  SweepSummary summary;
  summary.name = result.name;
  summary.revision = result.revision;
  summary.latest_revision = result.latest_revision;
  const std::vector<std::string> names =
      query.metrics.empty() ? default_metrics(result) : query.metrics;
  const std::vector<std::size_t> indices = metric_indices(result, names);
  for (const std::size_t index : indices) summary.metrics.push_back(result.metrics[index]);

  for (const Condition& condition : query.where) summary.conditions.push_back(condition.text);
  // Before anything is counted: all that follows is of the trials that are left.
  result = selected(std::move(result), query.where);
  if (result.trials.empty()) {
    throw InputError("no trial of sweep " + summary.name + " fulfils all conditions");
  }
  summary.planners = unique_labels(result.planners);
  const std::set<std::string> with_tracks = labels_with_tracks(result.spec_json);
  for (const PlannerRow& planner : result.planners) {
    summary.planner_versions.push_back(planner.version);
    summary.sees_tracks.push_back(with_tracks.contains(planner.label));
  }
  name_planners(result, summary.planners);
  summary.trial_count = static_cast<std::int64_t>(result.trials.size());
  // Invalid missions are in the maps, not among the trials.
  for (const MapRow& map : result.maps) {
    summary.mission_count += static_cast<std::int64_t>(map.record.missions.size());
    for (const MissionRecord& mission : map.record.missions) {
      summary.invalid_mission_count += mission.is_valid ? 0 : 1;
    }
  }

  if (const auto rule = limit_rule_of(result.spec_json)) {
    summary.limits = limits_of(result, *rule);
    summary.warnings = warnings_of(summary.limits);
    if (!query.group_by.empty()) {
      summary.warnings.emplace_back("not grouped: these trials were chosen to find limits");
    }
    summary.maps = std::move(result.maps);
    return summary;
  }
  const Trials trials = trials_on_maps(result);
  const std::vector<Trials> planners = by_planner(result, trials);
  summary.overall = summaries(result, trials, indices);
  summary.speeds = planner_speeds(result, planners);
  summary.best_settings = best_settings(summary.speeds, result.planners);
  summary.groups = groups_of(result, trials, indices);
  summary.group_columns = query.group_by;
  if (!query.group_by.empty()) {
    summary.group_rows = group_rows(result, trials, query.group_by, indices);
  }
  add_pairs_and_curves(summary, result, planners);
  summary.causes = cause_counts(result.trials, result.planners);
  summary.environment = environment_summary(result, trials);
  summary.warnings = warnings_of(summary, result);
  // Last: everything above reads them.
  summary.maps = std::move(result.maps);
  return summary;
}

/// Shards or machines of one sweep as one result. What is in several of them counts once, and
/// sorting by keys makes the order of the databases irrelevant.
SweepResult combined(std::vector<SweepResult> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  // Name, revision and spec are the same in all parts: they are of one sweep.
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
      // By label, then by key. No label has a zero byte.
      planners.emplace(row.label + '\0' + planner_key(row), row);
    // One key, one trial, bit for bit: whichever comes first.
    for (const TrialSummary& row : part.trials) trials.emplace(row.key, row);
    versions.insert(part.program_versions.begin(), part.program_versions.end());
    all.latest_revision = std::max(all.latest_revision, part.latest_revision);
    all.has_measured_latency = all.has_measured_latency || part.has_measured_latency;
    for (const MapRow& row : part.maps) {
      const auto [entry, is_new] = maps.emplace(row.record.key, row);
      if (is_new) continue;
      // Databases may know unlike numbers of a map's missions.
      std::vector<MissionRecord>& missions = entry->second.record.missions;
      for (const MissionRecord& mission : row.record.missions) {
        const bool is_there =
            std::any_of(missions.begin(), missions.end(),
                        [&](const MissionRecord& other) { return other.index == mission.index; });
        if (!is_there) missions.push_back(mission);
      }
      // Sums over missions depend on their order in the last bit.
      std::sort(missions.begin(), missions.end(),
                [](const auto& a, const auto& b) { return a.index < b.index; });
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
