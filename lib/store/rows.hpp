#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metrics/map_record.hpp"
#include "metrics/metric_table.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// One invocation of `avoidbench run`: where rows come from.
struct RunRow {
  std::string started_at;  ///< ISO 8601, UTC; provenance only
  std::string program_version, git_hash, compiler, flags, host, cpu, isa, command_line;
};

struct SweepRow {
  std::string name;
  std::string spec_json;  ///< resolved sweep, canonical
};

struct PlannerRow {
  std::string label, name, version, file_digest, parameters_json;
  bool is_privileged = false;  ///< sees the world itself
};

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
  std::vector<double> metrics;  ///< one a row of metric_table()
};

}  // namespace avoidbench
