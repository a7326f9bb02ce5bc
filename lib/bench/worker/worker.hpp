#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trial/trial_observer.hpp"
#include "worker/flight_journal.hpp"
#include "worker/job.hpp"

namespace avoidbench {

/// Exit codes of a worker that ends itself: a planner's call did not come back in time, the process
/// grew beyond its limit, its pipes are not its own any more, or it could not enter its sandbox.
inline constexpr int kHungExitCode = 86, kMemoryExitCode = 87, kPipesExitCode = 88,
                     kSandboxExitCode = 89;

/// How a worker process talks to its parent, and what it may use.
struct WorkerOptions {
  int in_fd = -1;       ///< jobs
  int out_fd = -1;      ///< results
  int notes_fd = -1;    ///< a zero byte a second while it lives, and the stack where it crashes
  int journal_fd = -1;  ///< memory for how far a flight has come: FlightJournal; -1: none
  double plan_timeout_s = 10.0;
  double memory_limit_mib = 0.0;  ///< of resident memory, that of its children included; 0: none
  std::string sandbox;            ///< as text(SandboxSupport) has it; "": none
  std::string allowed;            ///< in the sandbox, as text(SandboxRules) has it
};

/// Looks on in the worker while a trial is flown, for those who want to know more than its record.
struct Lookout {
  TrialObserver observer = {};
  bool wants_drawings = false;
  /// Where set: gets what the planner logged before its first and after its last call.
  std::function<void(const std::vector<std::string>&)> logged = {};
  /// Where set: asked before and after each call of the planner for what it has seen since; sent at
  /// once, so that no memory has to hold a whole flight. A flight that is begun again begins with a
  /// new lookout.
  std::function<std::optional<Message>()> take_piece = {};
  /// What it has seen, after the flight; null where there was none.
  std::function<Message(const TrialRecord*)> report;
};
/// Makes the one that Job::lookout asks for. The job and the world outlive it.
using LookoutMaker = std::function<Lookout(const Job&, const World&)>;
using LookoutMakers = std::map<std::string, LookoutMaker>;  ///< by LookoutJob::kind

/// Does jobs in this process and keeps what the next one may need again: the last map with its BVH,
/// planner libraries and instances. Move-only.
class Worker {
 public:
  explicit Worker(LookoutMakers lookouts = {});
  ~Worker();
  Worker(Worker&&) noexcept;
  Worker& operator=(Worker&&) noexcept;

  /// Never throws for what the user or a planner did wrong: that is JobResult::error, or an
  /// outcome.
  JobResult work(const Job& job);

  /// From now on each trial notes here how far it has come.
  void keep_journal(FlightJournal journal);
  /// From now on what planners print is kept short, between their calls.
  void trim_prints();
  /// From now on pieces of lookouts go there; without it they go nowhere.
  void send_pieces(std::function<void(const Message&)> send);

  /// Starts a thread that ends the process with one of the exit codes above where it must, and that
  /// says that it lives.
  void watch(const WorkerOptions& options);

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

/// A worker process's main loop: jobs in, results out, until the parent closes its end or is gone.
/// Returns the exit code.
int run_worker(const WorkerOptions& options, LookoutMakers lookouts = {});

}  // namespace avoidbench
