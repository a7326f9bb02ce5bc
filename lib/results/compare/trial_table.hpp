#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace avoidbench {

/// What makes two trials of two runs the same trial, as the sweep file has it: it stays when only
/// the program or the planner's file changed.
struct TrialIdentity {
  std::string planner;  ///< label
  std::string generator;
  std::uint64_t map_seed = 0;
  std::string
      setting;  ///< values of the sweep's other axes: "poisson_radius_m=3.5 sensor.kind=\"depth\""
  std::int64_t mission_index = 0;

  auto operator<=>(const TrialIdentity&) const = default;
};

/// `forest 1, poisson_radius_m=3.5, mission 4`: all but the planner.
std::string place_text(const TrialIdentity& identity);

/// A trial as comparisons need it.
struct TableTrial {
  TrialIdentity identity;
  std::uint64_t map = 0;  ///< beginning of the world's digest: maps are the clusters of intervals
  std::uint64_t mission =
      0;  ///< of a digest of world, start and goal: whether both flew the same mission
  Outcome outcome = Outcome::timed_out;
  /// Beginning of the digest of trajectory, plan calls and events; 0 where a table has none.
  std::uint64_t flight = 0;
  std::vector<double> metrics;  ///< one an element of TrialTable::metrics, NaN where there is none
  std::string cause = {};       ///< of a failure, where `explain` has told it; not in a CSV
  std::string key = {};         ///< in its database; "" for one from a CSV
};

/// The trials of one sweep, from a database or from a table that was committed.
struct TrialTable {
  std::string source;      ///< file, for messages
  std::string sweep = {};  ///< "forest", "forest@2"
  std::vector<std::string> axes = {};
  std::vector<MetricRow> metrics = {};
  std::vector<TableTrial> trials = {};  ///< by identity, which no two share
};

/// The table of a sweep in a database. `axes` are the paths whose values tell its trials apart.
/// Throws InputError where two trials share an identity (planners of one label, say).
TrialTable table_of_sweep(const Database& database, const SweepInfo& sweep,
                          std::vector<std::string> axes);

/// The table as CSV to be committed: definitions of the metrics in comment lines, then a line a
/// trial, numbers with the fewest digits that read back to the same bits. Metrics that are measured
/// on the host are left out: the file depends on nothing but the results.
std::string csv_of_table(const TrialTable& table);

/// Reads what csv_of_table() wrote, also of format 1, without flights. Throws InputError with file
/// and line.
TrialTable table_of_csv(const std::string& text, const std::string& source);

/// The two sides of a comparison: each a database or a CSV. `sweep` is NAME or NAME@2 for both
/// sides or FIRST:SECOND, one for each; "" means the latest revision of the one sweep that both
/// have. Throws InputError where files, sweeps or what to take are not clear.
struct TablePair {
  TrialTable base, now;
};
TablePair read_tables(const std::filesystem::path& base, const std::filesystem::path& now,
                      const std::string& sweep);

/// The trials of one planner on each side, paired as if it were one planner: "ego:mine" are ego's
/// of the base and mine's of the new results, "ego" ego's of both. Throws OptionError where a side
/// has no such label.
TablePair of_planners(TablePair tables, const std::string& wanted);

/// One side alone, as above.
TrialTable read_table(const std::filesystem::path& file, const std::string& sweep);

}  // namespace avoidbench
