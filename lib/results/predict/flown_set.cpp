#include "predict/flown_set.hpp"

#include <algorithm>
#include <set>

#include "base/input_error.hpp"
#include "base/words.hpp"
#include "report/selection.hpp"
#include "store/trial_fields.hpp"
#include "suite/suite_maps.hpp"

namespace avoidbench {
namespace {

/// A trial's value of a field, as words: nothing where the sweep does not vary it.
std::string value_text(const SweepResult& sweep, const TrialSummary& trial,
                       const std::string& field) {
  const auto at = std::find(sweep.fields.begin(), sweep.fields.end(), field);
  if (at == sweep.fields.end()) return "";
  const std::size_t place = static_cast<std::size_t>(at - sweep.fields.begin());
  return setting_text({field}, {trial.fields[place]}, {field});
}

/// Labels with the beginning of the key behind those that two planners share.
std::map<std::string, std::string> labels_by_key(const std::vector<SweepResult>& sweeps) {
  std::map<std::string, std::set<std::string>> keys_of;
  std::map<std::string, std::string> labels;
  for (const SweepResult& sweep : sweeps) {
    for (const PlannerRow& planner : sweep.planners) {
      keys_of[planner.label].insert(planner_key(planner));
      labels[planner_key(planner)] = planner.label;
    }
  }
  for (auto& [key, label] : labels) {
    if (keys_of[label].size() > 1) label += "@" + key.substr(0, 6);
  }
  return labels;
}

/// The maps of a suite's sweep in a split, by seed, as FlownMap.
std::map<std::uint64_t, FlownMap> suite_maps(const SuiteTrack& chosen, const SuiteCell& cell,
                                             const SuiteSweep& sweep, Split split) {
  const SweepSeeds seeds = seeds_of(chosen.suite, cell, sweep, split, "");
  const SweepSpec spec = suite_sweep(chosen, sweep, seeds, suite_planner("straight_line", "", {}));
  std::map<std::uint64_t, FlownMap> maps;
  for (const MapRow& map : measured_maps(spec, 0)) {
    maps[map.map_seed] = {map.generator, map.record.traversability_normalized_ratio};
  }
  return maps;
}

}  // namespace

std::size_t FlownSet::map_of(const std::string& key, const FlownMap& map) {
  const auto [at, is_new] = map_at_.emplace(key, maps.size());
  if (is_new) maps.push_back(map);
  return at->second;
}

FlownPlanner& FlownSet::planner_of(const std::string& label) {
  const auto at = std::lower_bound(
      planners.begin(), planners.end(), label,
      [](const FlownPlanner& planner, const std::string& name) { return planner.label < name; });
  if (at != planners.end() && at->label == label) return *at;
  return *planners.insert(at, {.label = label, .trials = {}});
}

std::vector<std::string> setting_fields(const SweepInfo& sweep) {
  std::vector<std::string> fields{"sensor", "vehicle"};
  for (const std::string& axis : axis_fields({&sweep, 1})) {
    const bool is_of_maps = axis.starts_with("map.") || axis == kSeedField;
    if (!is_of_maps && !contains(fields, axis)) fields.push_back(axis);
  }
  return fields;
}

void add_sweeps(FlownSet& set, const std::vector<SweepResult>& sweeps) {
  const std::map<std::string, std::string> labels = labels_by_key(sweeps);
  std::map<std::string, std::map<std::string, std::set<std::string>>> values;  // planner, field
  std::set<std::string> fields;
  for (const SweepResult& sweep : sweeps) fields.insert(sweep.fields.begin(), sweep.fields.end());
  for (const SweepResult& sweep : sweeps) {
    for (const TrialSummary& trial : sweep.trials) {
      for (const std::string& field : fields) {
        values[labels.at(trial.planner_key)][field].insert(value_text(sweep, trial, field));
      }
    }
  }
  for (const SweepResult& sweep : sweeps) {
    std::map<std::string_view, std::size_t> maps;
    for (const MapRow& map : sweep.maps) {
      maps[map.record.key] =
          set.map_of(map.record.key, {map.generator, map.record.traversability_normalized_ratio});
    }
    for (const TrialSummary& trial : sweep.trials) {
      std::string label = labels.at(trial.planner_key);
      for (const auto& [field, its] : values.at(label)) {
        const std::string value = value_text(sweep, trial, field);
        if (its.size() > 1 && !value.empty()) label += ", " + value;
      }
      set.planner_of(label).trials.push_back(
          {.map = maps.at(trial.map_key),
           .reference_length_m = trial.reference_length_m,
           .has_reached = trial.outcome == Outcome::reached_goal});
    }
  }
}

void add_suite_results(FlownSet& set, const std::vector<SuiteResult>& results,
                       const std::string& track) {
  std::set<std::string> tracks;
  for (const SuiteResult& result : results) tracks.insert(result.suite + "/" + result.track);
  std::map<std::string, std::map<std::uint64_t, FlownMap>> made;  // by suite, sweep and split
  for (const SuiteResult& result : results) {
    if (result.split == Split::sealed) {
      throw InputError(result.label + ": its maps are sealed, so that they can't be measured");
    }
    const SuiteTrack chosen =
        suite_track(track.empty() ? result.suite + "/" + result.track : track);
    const std::string problem = rows_problem(chosen.suite, result);
    if (!problem.empty()) throw InputError(result.label + ": " + problem);
    std::map<std::string, std::string> made_key;
    for (const SuiteCell& cell : chosen.suite.cells) {
      for (const SuiteSweep& sweep : cell.sweeps) {
        const std::string key =
            result.suite + "/" + sweep.name + "/" + std::string(text(result.split));
        made_key[sweep.name] = key;
        if (!made.contains(key)) made[key] = suite_maps(chosen, cell, sweep, result.split);
      }
    }
    FlownPlanner& planner =
        set.planner_of(tracks.size() > 1 ? result.track + ", " + result.label : result.label);
    for (const SuiteRow& row : result.rows) {
      const std::string& key = made_key.at(row.sweep);
      const std::string map_key = key + "/" + std::to_string(row.map_seed);
      planner.trials.push_back({.map = set.map_of(map_key, made.at(key).at(row.map_seed)),
                                .reference_length_m = row.reference_length_m,
                                .has_reached = row.outcome == Outcome::reached_goal});
    }
  }
}

}  // namespace avoidbench
