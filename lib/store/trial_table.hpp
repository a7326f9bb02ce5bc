#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "store/database.hpp"
#include "table/table_value.hpp"

namespace avoidbench {

class Statement;

/// The rows of the view trial_table, one in memory at a time, ordered by sweep, revision, planner,
/// planner_key, map_key, mission_index and trial_key, texts byte by byte. Seeds are without sign,
/// as in a sweep's file. The database has to outlive it.
class TrialTableReader {
 public:
  /// Rows of these revisions of sweeps; only of the map `map_key` where it is not empty. Behind the
  /// view's columns stand those of `axes`, by their paths, except those that the view has.
  TrialTableReader(const Database& database, std::span<const SweepInfo> sweeps,
                   std::string_view map_key = {}, std::span<const std::string> axes = {});
  ~TrialTableReader();
  TrialTableReader(TrialTableReader&& other) noexcept;
  TrialTableReader& operator=(TrialTableReader&& other) noexcept;

  const std::vector<std::string>& columns() const { return columns_; }
  /// Reads the next row; false where there is none.
  bool next();
  const std::vector<TableValue>& row() const { return row_; }  ///< as long as columns()

 private:
  std::unique_ptr<Statement> statement_;
  std::vector<std::string> columns_;
  std::vector<TableValue> row_;
  std::size_t seed_column_ = 0;
};

/// The generators of the maps that these sweeps have trials on.
std::vector<std::string> generators_of(const Database& database, std::span<const SweepInfo> sweeps);

/// Where the trials of a sweep on one map come from.
struct MapFlights {
  std::string map_key;
  RunRow first_run;           ///< the earliest of those that flew them
  double time_limit_s = 0.0;  ///< the longest of a trial
  double wall_time_s = 0.0;   ///< that all trials took; those whose time isn't known count 0
};

/// The maps on which the sweep has finished trials, by generator, seed and key.
std::vector<MapFlights> read_map_flights(const Database& database, const SweepInfo& sweep);

/// Reads one trial after the other, with statements that are prepared once.
class TrialReader {
 public:
  /// The database must outlive the reader and serve the same thread.
  explicit TrialReader(const Database& database);
  TrialReader(TrialReader&& other) noexcept;
  ~TrialReader();

  /// As Database::read_trial().
  std::optional<TrialRow> read(std::string_view key);

 private:
  struct Statements;
  const Database* database_;
  std::unique_ptr<Statements> statements_;
};

}  // namespace avoidbench
