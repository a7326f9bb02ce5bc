#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "process/sandbox.hpp"
#include "store/database.hpp"
#include "sweep/file_state.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/run_sweep.hpp"
#include "sweep/schedule.hpp"
#include "worker/job.hpp"
#include "worker/worker_death.hpp"

/// A run as its parent process sees it, and what becomes of jobs.
namespace avoidbench {

/// What the parent process knows of a run. It alone writes the database. Each trial of the schedule
/// comes to exactly one end: it was there before, its mission is invalid, it is committed by
/// take_result() or take_death(), or it is in `unflown`, which is not stored. So progress.done
/// counts what the database has.
struct Run {
  const SweepSpec& sweep;
  const RunOptions& options;
  const RunRow& provenance;
  Database& database;
  /// Of the round under way, where the sweep has a rule to stop by; else of the whole sweep.
  Schedule schedule;
  Progress progress;
  RecordedLatencies recorded;
  std::map<std::string, FileState> planner_files;     ///< by path, as they were at the beginning
  std::map<std::string, SandboxRules> sandbox_rules;  ///< by planner label
  std::set<std::string> planners_with_globals;        ///< labels: see AB_USES_GLOBALS
  std::vector<UnflownTrial> unflown;
  std::map<std::string, int> left_behind;  ///< processes, by label of the planner that left them
  std::map<std::string, std::string> last_words;  ///< of workers that died, by key of their trial
  bool has_begun = false;                         ///< the database knows of this run

  bool is_stopped() const { return options.stop != nullptr && options.stop->load(); }
};

void report_progress(const Run& run);

/// The job to be done; a new token each time.
Job job_of(Run& run, const Assignment& assignment);

/// Takes from the database the maps that an earlier run measured with at least as many missions,
/// where trials are left to be flown on them.
void recall_maps(Run& run);

/// Commits what a worker answered. Throws InputError for what stops the sweep as a whole.
void take_result(Run& run, const Assignment& assignment, JobResult result);

/// Commits a trial whose worker is gone: it has an outcome all the same, and the flight up to the
/// last call. A map without one throws InputError.
void take_death(Run& run, const Assignment& assignment, const Job& job, const Death& death);

}  // namespace avoidbench
