#pragma once

#include <string>
#include <vector>

#include "replay/replay.hpp"
#include "worker/job.hpp"

namespace avoidbench {

/// How a worker is started that flies a trial again, and how long it may take.
struct ApartOptions {
  std::vector<std::string> worker_command;  ///< as RunOptions::worker_command
  std::string sandbox;                      ///< as RunOptions::sandbox
  double silence_s = 30.0, trial_timeout_s = 3600.0;
};

/// What became of a flight in a process of its own, whose planner may crash or hang.
struct ApartFlight {
  TrialRecord record;
  bool has_begun = false;          ///< the planner was called; else the record has no path
  std::string printed;             ///< by the planner, bounded: see PrintTrimmer
  std::vector<std::string> stack;  ///< where it crashed or hung, innermost first; empty: it did not
  std::vector<std::string> warnings;  ///< why it may differ from the stored flight
  /// How somebody else ended the worker: "signal 9 (Killed)", and `record` is no result; "":
  /// nobody.
  std::string killed_by = {};
};

/// The job of flying a stored trial again with this planner, and parameters that it takes; `stored`
/// is that of with_files(). Why it may differ from the stored flight is added to `warnings`.
Job stored_job(StoredTrial stored, const PlannerDescription& planner,
               std::vector<std::string>& warnings);

/// Flies a stored trial again in a worker process, as a sweep does: a crash or a hang of the
/// planner is an outcome. Throws InputError as Replay, and where there can't be a worker.
ApartFlight fly_apart(const StoredTrial& stored, const ReplayFiles& files,
                      const ApartOptions& options);

}  // namespace avoidbench
