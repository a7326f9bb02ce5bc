#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/map_record.hpp"
#include "metrics/metric_table.hpp"
#include "table/table_value.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// One invocation of `avoidbench run`: where rows come from.
struct RunRow {
  std::string started_at;  ///< ISO 8601, UTC; provenance only
  std::string program_version, git_hash, compiler, flags, host, cpu, isa, command_line;
  std::string shard;         ///< "2/3": of its sweep it flew the second third only
  std::string sandbox = {};  ///< what shut the planners in: "landlock 4, seccomp", "none: reason"
};

struct SweepRow {
  std::string name;
  std::string spec_json;  ///< resolved sweep, canonical
};

struct PlannerRow {
  std::string label, name, version, file_digest, parameters_json;
  bool is_privileged = false;  ///< sees the world itself
};

/// The planner's key in the database: digest of all fields, so that one label never covers two
/// planners.
std::string planner_key(const PlannerRow& row);

struct MapRow {
  MapRecord record;
  std::string generator;
  std::string spec_json;
  std::uint64_t map_seed = 0;
};

/// One finished trial, ready to be committed.
struct TrialRow {
  std::string key, sweep, map_key, planner_label;
  std::string planner_file_digest;
  std::int64_t mission_index = 0;
  std::string spec_json;  ///< canonical TrialSpec: enough to fly it again
  TrialRecord record;
  std::vector<double> metrics;                                    ///< one a row of metric_table()
  double wall_time_s = std::numeric_limits<double>::quiet_NaN();  ///< it took; NaN: not known
};

/// What became of a stored trial that was flown again with one thing changed.
struct WhatIfRow {
  std::string trial_key, change;
  Outcome outcome = Outcome::timed_out;
  std::string reason;
  double end_time_s = 0.0;  ///< NaN where not known
  std::string program_version, planner_digest;
  std::string record_digest;  ///< record_digest() of the flight

  bool operator==(const WhatIfRow&) const = default;
};

/// Why a stored trial failed (the room explain).
struct ExplanationRow {
  std::string trial_key, cause, facts_json;
  std::int64_t rules_version = 0;
  std::string record_digest;  ///< record_digest() of the flight that it is of

  bool operator==(const ExplanationRow&) const = default;
};

/// A metric's definition as stored beside the values.
struct MetricRow {
  std::string name;
  int version = 0;
  std::string unit, doc, formula, source;
  Better better = Better::neither;
  Population population = Population::all;
  bool is_measured = false;

  bool operator==(const MetricRow&) const = default;
};

/// A sweep in the database. A changed sweep of the same name is a new revision, so that its trials
/// never mix with those of the former one; a trial that both have is stored once and belongs to
/// both.
struct SweepInfo {
  std::string name;
  std::int64_t revision = 1;  ///< from 1
  std::string spec_json;
  std::int64_t trial_count = 0;
};

/// What a trial takes, on the mean.
struct TrialCost {
  double wall_time_s = 0.0;  ///< of the trials whose time is known; 0 where none is
  double bytes = 0.0;        ///< in the file
};

/// One trial of a database as a list of them shows it.
struct TrialListing {
  std::int64_t id =
      0;  ///< for people: a small number, of this file and as long as it isn't rebuilt
  std::string key, planner_label, generator;
  std::uint64_t map_seed = 0;
  std::int64_t mission_index = 0;
  Outcome outcome = Outcome::timed_out;
  std::string reason;
  double end_time_s = 0.0;  ///< NaN where not known
  Mission mission = {};
  std::string map_key = {};
  bool is_recorded = false;             ///< flown in reality: nothing can fly it again
  std::vector<TableValue> fields = {};  ///< one an element of those that were asked for
  std::string setting =
      {};  ///< those of the fields that sweeps vary: "poisson_radius_m 3.5, ms 40"
};

/// Ends the labels of planners that flew in reality: their simulated twins have the rest.
inline constexpr std::string_view kRealLabel = "_real";

/// What reports need of one trial.
struct TrialSummary {
  std::string key = {}, planner_key = {}, map_key = {};
  std::int64_t mission_index = 0;
  Outcome outcome = Outcome::timed_out;
  double reference_length_m = 0.0;
  double end_time_s = 0.0;  ///< simulated
  /// As SweepResult::metrics has them; NaN where the trial has none.
  std::vector<double> metrics = {};
  std::vector<TableValue> fields = {};  ///< one an element of SweepResult::fields
  std::string cause = {};  ///< of a failure, as `explain` has told it; "" where it has not
};

/// d_min / T, m/s; 0 where the goal was not reached.
double goal_velocity_mps(const TrialSummary& trial);

/// All that reports need of one sweep. Everything is ordered by key, whatever the order of
/// insertion.
struct SweepResult {
  std::string name;
  std::int64_t revision = 1;
  std::int64_t latest_revision = 1;  ///< that the database has
  std::vector<MetricRow> metrics;
  std::vector<PlannerRow> planners;  ///< that flew, by label
  std::vector<MapRow> maps;          ///< with the missions that the sweep asked for
  std::vector<TrialSummary> trials;
  std::vector<std::string>
      program_versions;                  ///< `version git_hash` of the runs that made the trials
  std::string spec_json = {};            ///< of the sweep
  std::vector<std::string> fields = {};  ///< that were asked for
  bool has_measured_latency = false;     ///< times that some machine took decide about its flights
};

}  // namespace avoidbench
