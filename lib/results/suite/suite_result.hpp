#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "store/database.hpp"
#include "suite/suite_planner.hpp"
#include "suite/suite_spec.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// One flight of a result.
struct SuiteRow {
  std::string cell, sweep;
  std::uint64_t map_seed = 0;
  std::int64_t mission_index = 0;
  std::string trial_key;
  Outcome outcome = Outcome::timed_out;
  double reference_length_m = 0.0;
  double end_time_s = 0.0;         ///< NaN where not known
  double goal_velocity_mps = 0.0;  ///< reference length over time; 0 where the goal was not reached
  double path_length_m = 0.0;
  std::string cause;          ///< of a failure, where it was told
  std::string flight_digest;  ///< of trajectory, plan calls and events (store/row_digest.hpp)

  bool operator==(const SuiteRow&) const = default;
};

/// What a folder of a result says.
struct SuiteResult {
  std::string suite, track_sha256, track;
  Split split = Split::open;
  std::string key_sha256;  ///< of sealed maps' key
  std::string label, planner_name, planner_version, planner_digest, program;
  bool is_privileged = false;
  SuitePlanner planner;
  std::vector<SuiteRow> rows;  ///< by cell and sweep as the suite has them, map and mission
};

inline constexpr const char* kTrialsFile = "trials.csv";
inline constexpr const char* kPlannerFile = "planner.yaml";

/// The flights of the latest revisions of the suite's sweeps in a database, in the suite's order.
std::vector<SuiteRow> rows_of(const Database& database, const SuiteSpec& suite);

/// Writes trials.csv and planner.yaml.
void write_result(const SuiteResult& result, const std::filesystem::path& folder);

/// Reads what write_result() wrote. Throws InputError with file, line and column.
SuiteResult read_result(const std::filesystem::path& folder);

/// Why the rows can't be one flight for each mission of the split: a cell, sweep, map or mission
/// that the suite has not, one twice, some missing, or a goal velocity that is not the length over
/// the time. "" where they can. Keys and flights are verify's.
std::string rows_problem(const SuiteSpec& suite, const SuiteResult& result);

/// How many missions the split has.
std::int64_t mission_count(const SuiteSpec& suite, Split split);

}  // namespace avoidbench
