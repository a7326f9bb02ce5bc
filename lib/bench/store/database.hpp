#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "store/rows.hpp"

struct sqlite3;

namespace avoidbench {

inline constexpr int kApplicationId = 0x6176426e;  ///< "avBn", in the SQLite header of our files
inline constexpr int kSchemaVersion = 1;

class RunLock;

/// Called about ten times a second while another program's lock is in the way, with the time waited
/// so far; false gives up, which is an InputError. Must not throw.
using OnWait = std::function<bool(double waited_s)>;

/// One database file of results. The schema, and with it the meaning of every column, is in
/// schema.sql. A handle serves one thread. All functions throw InputError, naming the file, when
/// the disk or another program stands in the way; what was committed before stays.
class Database {
 public:
  /// Opens `path` for writing; makes it when it doesn't exist or is empty (its folder has to
  /// exist). `metrics` are the program's: a metric that the file lacks becomes a new column, NULL
  /// in trials that are already there. Throws InputError when the file is no database of ours, is
  /// damaged, is locked, can't be written, was made by a newer program, holds triggers or tables of
  /// other columns than ours, is being written to by another run or merge, or defines a metric in
  /// another version than `metrics` do. Without `on_wait`, locks of other programs are waited for
  /// ten seconds.
  static Database open_for_run(const std::filesystem::path& path,
                               std::span<const MetricDef> metrics, OnWait on_wait = {});

  /// Opens an existing file, also one that can't be written. Throws InputError as open_for_run().
  /// The file's own views are not used.
  static Database open_for_reading(const std::filesystem::path& path);

  Database(Database&& other) noexcept;
  Database& operator=(Database&& other) noexcept;
  ~Database();

  const std::filesystem::path& path() const { return *path_; }

  /// Ends the connection, as the destructor does. A database that was opened for a run is one file
  /// afterwards if nobody reads it. Nothing but path() may be called afterwards.
  void close();

  /// Moves what was committed from the log beside the file into the file, as far as readers let it,
  /// without waiting, as SQLite does by itself every 1000 pages of log (4 MiB). Throws InputError
  /// where the file can't be written any more, and as require_in_place().
  void checkpoint();

  /// Throws InputError where the file of a run was deleted, moved or replaced since it was opened;
  /// it says where all committed rows are: under the file's new name, or in a new file
  /// `NAME.rescued.db` beside the deleted one. Each of the functions that write ends with it.
  void require_in_place();

  /// Whether OnWait gave up waiting for a lock.
  bool has_given_up() const { return wait_->has_given_up; }

  /// The metrics, in the order of TrialRow::metrics.
  const std::vector<MetricRow>& metrics() const { return metrics_; }

  // Writing. Each call is one transaction; adding what is already there changes nothing, if not
  // said otherwise.

  /// Adds the run that trials added from now on belong to.
  std::int64_t add_run(const RunRow& row);
  /// Adds the sweep, or finds it. Another spec_json than that of the revisions there are makes a
  /// new revision. Later calls that name the sweep mean this revision.
  std::int64_t add_sweep(const SweepRow& row);
  /// Later trials of this label and file digest belong to this planner.
  void add_planner(const PlannerRow& row);
  /// Adds the map and those of its missions that are new, and notes that `sweep` asks for these
  /// missions. Throws InputError when the map or a mission is there with other values: then the
  /// program's results have changed.
  void add_map(const MapRow& row, std::string_view sweep);
  /// Commits the trial with its trajectory, plan calls and events, and adds it to `row.sweep`. Run,
  /// sweep, map and planner must have been added before. A trial that is there is replaced and its
  /// `attempt` rises by one.
  void add_trial(const TrialRow& row);
  /// Commits what became of a trial that was flown again with something changed, in place of an
  /// older row of the same trial and change. The trial must be there.
  void add_what_if(const WhatIfRow& row);
  /// Commits why a trial failed, in place of an older row of the trial, which must be there.
  void add_explanation(const ExplanationRow& row);
  /// Notes that these finished trials belong to `sweep` too; keys of unfinished ones are passed
  /// over.
  void add_to_sweep(std::string_view sweep, std::span<const std::string> keys);

  // Reading.

  std::map<std::string, Outcome> finished_trials() const;
  /// d_min / T by trial key, m/s; 0 where the goal was not reached.
  std::map<std::string, double> goal_velocities_mps() const;
  std::set<std::string> finished_keys() const;
  std::optional<MapRow> read_map(std::string_view key) const;
  std::optional<TrialRow> read_trial(
      std::string_view key) const;  ///< `sweep` is one that it belongs to
  /// All, by id, each with these fields (trial_fields.hpp). Throws InputError for a field that no
  /// trial can have.
  std::vector<TrialListing> list_trials(const std::vector<std::string>& fields = {}) const;
  std::vector<TrialListing> list_trials(std::string_view sweep,
                                        std::int64_t revision) const;  ///< those of a sweep, by id
  std::map<std::string, TrialCost> mean_costs() const;                 ///< by planner label
  /// By trial key, then change. Throws InputError for a row that is not as it was stored.
  std::vector<WhatIfRow> read_what_ifs() const;
  /// By trial key. Throws as read_what_ifs().
  std::vector<ExplanationRow> read_explanations() const;
  std::vector<PlannerRow> read_planners() const;  ///< by label, then key
  std::vector<SweepInfo> read_sweeps() const;     ///< by name, then revision
  /// The sweep with its trials, and of each trial these fields (trial_fields.hpp). Throws
  /// InputError for a field that no trial can have.
  SweepResult read_sweep(std::string_view name, std::int64_t revision,
                         const std::vector<std::string>& fields = {}) const;

  /// SQLite's handle, for this room and custom_metrics only.
  sqlite3* handle() const { return handle_.get(); }
  /// Makes the views anew where sweeps were added that vary something else, for this room only.
  /// Within a transaction.
  void remake_views();
  /// The file as SQLite opened it, for this room only.
  const std::string& uri() const { return uri_; }

 private:
  struct Close {
    bool is_writer;  // of a database that was found to be ours
    void operator()(sqlite3* handle) const;
  };

  /// While a lock is waited for.
  struct Wait {
    OnWait on_wait;
    std::chrono::steady_clock::time_point began;
    bool has_given_up = false;
  };

  Database(std::filesystem::path path, std::unique_ptr<sqlite3, Close> handle);
  static Database connect(const std::filesystem::path& path, int flags, std::string_view options,
                          OnWait on_wait);
  static int wait_for_lock(void* wait, int count);
  void check_identity() const;
  void check_integrity(bool whole) const;
  void check_references() const;
  /// `has_columns`: schema.sql has just made them.
  void bring_metrics(std::span<const MetricDef> metrics, bool has_columns);
  void read_metrics();
  void make_views(bool is_in_file);
  std::string rescued_copy();
  std::int64_t revision_of(std::string_view sweep) const;

  std::unique_ptr<const std::filesystem::path>
      path_;  // behind a pointer: statements keep a reference while we may move
  std::string uri_;
  std::unique_ptr<Wait> wait_;     // at an address that stays: SQLite keeps it
  std::unique_ptr<RunLock> lock_;  // before the handle: closed after it (see RunLock)
  std::unique_ptr<sqlite3, Close> handle_;
  std::vector<MetricRow> metrics_;
  std::string views_;  // as they were made last
  std::int64_t run_id_ = 0;
  std::map<std::string, std::int64_t, std::less<>> revisions_;  // of the sweeps added here
  std::map<std::pair<std::string, std::string>, std::string>
      planners_;  // (label, file digest) → key
};

}  // namespace avoidbench
