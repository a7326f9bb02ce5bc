#pragma once

#include <memory>
#include <string>

#include "sweep/job.hpp"

namespace avoidbench {

/// Exit code of a worker whose planner did not come back from a call in time.
inline constexpr int kHungExitCode = 86;

/// Does jobs in this process and keeps what the next one may need again: the last map with its BVH,
/// planner libraries and instances. Move-only.
class Worker {
 public:
  Worker();
  ~Worker();
  Worker(Worker&&) noexcept;
  Worker& operator=(Worker&&) noexcept;

  /// Never throws for what the user or a planner did wrong: that is JobResult::error, or an
  /// outcome.
  JobResult work(const Job& job);

  /// Ends the process with kHungExitCode when a planner's call lasts longer than this. A thread of
  /// its own watches.
  void end_process_after(double plan_timeout_s);

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

/// A worker process's main loop: jobs from `in_fd`, results to `out_fd`, until the parent closes
/// its end. Returns the exit code.
int run_worker(int in_fd, int out_fd, double plan_timeout_s);

}  // namespace avoidbench
