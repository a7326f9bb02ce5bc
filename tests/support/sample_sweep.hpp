#pragma once

#include <algorithm>
#include <string>

#include "support/sample_rows.hpp"

/// Results made by hand for tests of reports.
namespace avoidbench::sample_sweep {

using namespace sample_rows;

/// `map_count` maps of `mission_count` missions, flown by planners of these names, which succeed
/// where `succeeds` says so.
template <class Succeeds>
inline SweepResult result_of(int map_count, int mission_count, Succeeds succeeds,
                             const std::vector<const char*>& labels = {"a", "b"}) {
  SweepResult result;
  result.name = "forest";
  for (const MetricDef& def : kMetrics) {
    result.metrics.push_back({.name = std::string(def.name),
                              .version = def.version,
                              .unit = std::string(def.unit),
                              .doc = std::string(def.doc),
                              .formula = "",
                              .source = "",
                              .better = def.better,
                              .population = def.population,
                              .is_measured = def.is_measured});
  }
  for (const char* label : labels) result.planners.push_back(planner_row(label));
  for (int map = 0; map < map_count; ++map) {
    result.maps.push_back(map_row(map, mission_count));
    for (int mission = 0; mission < mission_count; ++mission) {
      for (const char* label : labels) {
        const bool is_finished = succeeds(label[0], map, mission);
        const TrialRow row =
            trial_row(label, map, mission, is_finished ? Outcome::reached_goal : Outcome::collided);
        result.trials.push_back({.key = row.key,
                                 .planner_key = planner_key(planner_row(label)),
                                 .map_key = row.map_key,
                                 .mission_index = mission,
                                 .outcome = row.record.outcome,
                                 .reference_length_m = 40.0 + mission,
                                 .end_time_s = row.record.end_time_s,
                                 .metrics = row.metrics});
      }
    }
  }
  result.program_versions = {"0.1.0 abcdef"};
  return result;
}

/// Whether one of a summary's warnings has this part.
template <class Summary>
bool has_warning(const Summary& summary, const std::string& part) {
  return std::any_of(summary.warnings.begin(), summary.warnings.end(),
                     [&](const std::string& w) { return w.find(part) != std::string::npos; });
}

}  // namespace avoidbench::sample_sweep
