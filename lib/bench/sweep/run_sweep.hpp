#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "fleet/fleet.hpp"
#include "store/database.hpp"
#include "sweep/schedule.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// Success so far of one planner, for the progress line.
struct PlannerProgress {
  std::int64_t flown = 0, reached_goal = 0;
};

struct Progress {
  std::int64_t total = 0, done = 0, done_before = 0;
  /// Trials that can't be flown: no free start or goal, or no way between them.
  std::int64_t invalid_missions = 0;
  /// Further rounds may follow: `total` is what was asked for so far.
  bool is_open = false;
  std::map<std::string, PlannerProgress> planners;  ///< by label, trials of this run
};

/// Which finished trials are flown again.
enum class Rerun { none, failed, all, chosen };

/// A sweep that the database has with other contents, too.
struct SweepRevision {
  std::int64_t revision = 1, latest = 1;
  bool is_new = false;               ///< made by this run
  std::vector<std::string> changes;  ///< of a new one: where it differs from the one before
};

/// A run's trials are flown by a fleet.
struct RunOptions : FleetOptions {
  Shard shard;
  Rerun rerun = Rerun::none;  ///< failed: that ended in an error, a crash or a hang of the planner
  std::string rerun_key;      ///< of the chosen one: the key or its beginning
  std::function<bool(const std::string& key)> is_wanted = {};  ///< null: all trials are flown
  /// Trials fly in this process, one after the other, for debuggers. Crashes and hangs are not
  /// caught then, and the C library's processor-dependent functions are in use by planners.
  bool in_process = false;
  /// Copies of the planners, and of the maps and wind fields, are kept beside the database.
  bool keep_planners = false, keep_maps = false;
  std::function<void(const Progress&)> on_progress;  ///< at each change, and each second
  /// Before the first trial, where the sweep has several revisions.
  std::function<void(const SweepRevision&)> on_revision = {};
};

/// A trial that is not in the database, since its workers were killed from outside: kMostTries.
struct UnflownTrial {
  std::string key, planner_label;
  std::string reason;  ///< "signal 9 (Killed)", and of its map: "…, while it measured the map"
};

struct RunSummary {
  Progress progress;
  std::int64_t revision = 0;  ///< of the sweep, in the database
  bool is_stopped = false;
  std::vector<UnflownTrial> unflown;
  std::vector<std::string> unkept;         ///< files of which no copy could be kept, and why
  std::map<std::string, int> left_behind;  ///< processes that were ended, by label of the planner
  std::map<std::string, std::string>
      last_words;  ///< the last line that workers printed which died, by key of their trial
};

/// Flies every trial of the sweep that the database lacks, in worker processes, and commits each as
/// it ends, one transaction a trial. The rows do not depend on the number of workers nor on the
/// order in which trials end. A worker that dies costs the trial it flew (planner_crashed,
/// planner_hung) and is replaced. Throws InputError for what stops the sweep as a whole: a map that
/// can't be made, a database that can't be written, a planner's file that changes under way.
RunSummary run_sweep(const SweepSpec& sweep, const RunRow& provenance, Database& database,
                     const RunOptions& options);

}  // namespace avoidbench
