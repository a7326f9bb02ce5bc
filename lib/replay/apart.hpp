#pragma once

#include <string>
#include <vector>

#include "replay/replay.hpp"

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
};

/// Flies a stored trial again in a worker process, as a sweep does: a crash or a hang of the
/// planner is an outcome. Throws InputError as Replay, and where there can't be a worker.
ApartFlight fly_apart(const StoredTrial& stored, const ReplayFiles& files,
                      const ApartOptions& options);

}  // namespace avoidbench
