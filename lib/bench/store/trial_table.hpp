#pragma once

#include <cstdint>
#include <functional>
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
  /// Rows of these revisions of sweeps, with the columns of `axes` (axis_fields()) instead of those
  /// of all sweeps of the file.
  TrialTableReader(const Database& database, std::span<const SweepInfo> sweeps,
                   const std::vector<std::string>& axes = {});
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

/// The paths of the axes of a sweep's stored spec, in its order: "map.poisson_radius_m".
std::vector<std::string> axis_paths(std::string_view sweep_spec_json);

/// A trial of a sweep, without its flight and spec.
struct VisitedTrial {
  std::string key, planner_key, map_key;
  std::int64_t mission_index = 0;
  Outcome outcome = Outcome::timed_out;
  std::string cause;            ///< of a failure, where it is told
  std::string flight_digest;    ///< see store/row_digest.hpp
  std::vector<double> metrics;  ///< in the order of Database::metrics(), NaN where there is none
  std::vector<std::string>
      settings;  ///< what its spec says at the paths, as JSON text; "" for none
};

/// Calls `visit` for each trial of a sweep, in any order. `paths` are dotted
/// ("sensor.fov_x_deg"). Each row is read once: for large databases.
void visit_trials(const Database& database, std::string_view sweep, std::int64_t revision,
                  std::span<const std::string> paths,
                  const std::function<void(VisitedTrial)>& visit);

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
