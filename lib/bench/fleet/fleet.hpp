#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "process/sandbox.hpp"
#include "worker/crash_report.hpp"
#include "worker/job.hpp"
#include "worker/worker_death.hpp"

namespace avoidbench {

/// A job is given up, and JobEnd::killed_by says so, when so many workers that had it were killed
/// from outside: once may be chance, such as memory that another process took.
inline constexpr int kMostTries = 3;

/// What a worker process has in memory.
struct Memory {
  std::optional<std::size_t> map;  ///< by the caller's number
  std::string planner_label;       ///< of the one whose code ran there; "": none yet
};

/// A job that waits for a worker.
struct FleetJob {
  std::size_t index = 0;  ///< the caller's
  Job job;
  std::size_t map = 0;             ///< the caller's number of its map
  std::string planner_label = {};  ///< whose code it runs; "": nobody's
  SandboxRules rules = {};         ///< what the planner needs
  bool needs_new_process = false;  ///< where its planner ran before: see AB_USES_GLOBALS
  /// Where its lookout has pieces: gets each as it comes. A flight that is begun again begins with
  /// its first piece again.
  std::function<void(const Message&)> on_piece = {};
};

/// How a job ended: exactly one of the first three is set.
struct JobEnd {
  std::optional<JobResult> answer = {};
  std::optional<Death> death = {};  ///< its worker's, with how far the flight had come
  std::string killed_by = {};       ///< by somebody else each time: "signal 9 (Killed)"
  std::string printed = {};  ///< by the worker, bounded: see PrintTrimmer; of a lookout's job
  CrashStack stack = {};     ///< where it died
};

/// How jobs are done several at once.
struct FleetOptions {
  std::vector<std::string> worker_command;  ///< starts a worker; four file descriptors are appended
  std::string sandbox;      ///< that workers enter, as text(SandboxSupport) has it; "": none
  int jobs = 1;             ///< worker processes
  double silence_s = 30.0;  ///< a worker that says for so long not even that it lives is ended
  double trial_timeout_s = 3600.0;              ///< wall time after which a trial ends as hung
  double grace_s = 30.0;                        ///< after `stop`, for what flies
  const std::atomic<bool>* stop = nullptr;      ///< set: begin nothing more
  const std::atomic<bool>* stop_now = nullptr;  ///< set: end what flies
  /// Where set: before each worker whose sandbox grants a planner what it declares to need.
  std::function<void(const FleetJob&)> on_granted = {};
  std::function<void()> on_turn = {};  ///< where set: once a second or more often, while jobs go on
};

/// Does jobs in worker processes, several at once: the one way in which trials are flown.
/// An idle worker gets what `next` gives for what it has in memory; nothing: there is none for it
/// now. `ended` gets each as it ends; both are called by this thread. A process runs one planner's
/// code only, so that what one does to its process is no other one's misfortune, and lives in the
/// sandbox of that planner's rules. A job whose worker was killed from outside is done again by a
/// new one, kMostTries in all. A worker that a signal has stopped is continued.
/// Returns when nobody has a job and `next` gives none, or when it is stopped: jobs without an end
/// are then not done. No process is left of those that it and its planners started; returns how
/// many of those that planners left behind had to be ended, by planner. What `next`, `ended` or a
/// worker that can't be started throws ends it.
std::map<std::string, int> fly(const std::function<std::optional<FleetJob>(const Memory&)>& next,
                               const std::function<void(const FleetJob&, JobEnd)>& ended,
                               const FleetOptions& options);

}  // namespace avoidbench
