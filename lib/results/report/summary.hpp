#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "report/environment_summary.hpp"
#include "report/limits.hpp"
#include "report/planner_summary.hpp"
#include "report/response.hpp"
#include "report/selection.hpp"
#include "report/speeds.hpp"
#include "sweep/cause_counts.hpp"

namespace avoidbench {

/// What a report is asked for.
struct ReportQuery {
  std::vector<std::string> metrics;   ///< empty: default_metrics()
  std::vector<GroupColumn> group_by;  ///< empty: planners by five groups of traversability
  std::vector<Condition> where;

  /// Every field that columns and conditions name, each once: what Database::read_sweep() is to
  /// read.
  std::vector<std::string> fields() const;
};

/// Maps of like difficulty, and how each planner fared there.
struct MapGroup {
  std::int64_t map_count = 0;
  double lowest_ratio = 0.0, highest_ratio = 0.0;  ///< of their traversability_normalized_ratio
  std::vector<PlannerSummary> planners;
};

/// One row of what was asked for by ReportQuery::group_by.
struct GroupRow {
  std::vector<TableValue> keys;
  std::int64_t map_count = 0;
  PlannerSummary summary;  ///< of all planners together where `planner` is no key
};

/// What a report says of one sweep.
struct SweepSummary {
  std::string name;
  std::int64_t revision = 1, latest_revision = 1;
  std::vector<std::string> conditions;  ///< those that the trials fulfil, as they were written
  std::vector<MetricRow> metrics;       ///< those that were asked for
  std::vector<std::string>
      planners;  ///< labels; with the start of the key where two planners share one
  std::vector<std::string> planner_versions;  ///< one a planner
  std::vector<bool> sees_tracks;              ///< one a planner: told of movers beside its sensors
  std::vector<MapRow> maps;
  std::int64_t mission_count = 0, invalid_mission_count = 0, trial_count = 0;
  std::vector<PlannerSummary> overall;
  std::vector<PlannerSpeeds> speeds;       ///< one a planner
  std::vector<BestSetting> best_settings;  ///< of planners that flew with several
  std::vector<MapGroup> groups;            ///< from hard to easy maps; empty for fewer than 2 maps
  std::vector<GroupColumn> group_columns;
  std::vector<GroupRow> group_rows;  ///< empty without ReportQuery::group_by
  std::vector<Contrast> contrasts;
  std::vector<DifficultyResponse> difficulty;  ///< one a planner; empty for fewer than kLeastMaps
  std::vector<FlightTimes> flight_times;       ///< one a planner
  std::vector<CauseCount> causes;              ///< of failures; empty where none is told
  EnvironmentSummary environment;
  /// Of a sweep that looks for limits; then planners, rates and means are left out, since the
  /// trials were chosen by what they tell of the limit and are no sample of any setting.
  LimitSummary limits;
  std::vector<std::string> warnings;  ///< what the figures can't carry
};

/// Those of the usual metrics that `result` has: path and energy optimality, average goal velocity,
/// mission progress, processing time (CPU and wall).
std::vector<std::string> default_metrics(const SweepResult& result);

/// What a sweep needs beside a query's fields: that of its limit.
void add_limit_field(const std::string& spec_json, std::vector<std::string>& fields);

/// The summary; `result` has the fields of `query`. Throws InputError for a metric that the results
/// lack, for conditions that no trial fulfils, and as group_trials().
SweepSummary summarize(SweepResult result, const ReportQuery& query = {});

/// One sweep's trials out of several databases (shards); a trial that several have counts once.
/// Throws InputError when they define metrics differently.
SweepResult combined(std::vector<SweepResult> parts);

/// Warnings of what `summary` of `result` can't carry: few trials, rates that can't be told apart,
/// planners that compute for longer than their flights let them, trials of different programs or
/// latencies that were measured, trials that are still to fly.
std::vector<std::string> warnings_of(const SweepSummary& summary, const SweepResult& result);

}  // namespace avoidbench
