#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "replay/apart.hpp"
#include "worker/job.hpp"
#include "worker/worker_death.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {

/// A worker process that flies one job after the other while its caller looks after others, too:
/// only wait_for_news() waits. It should fly one planner only, so that what one does to its process
/// is no other one's misfortune. Kills the process when destroyed.
class ApartWorker {
 public:
  /// `needs` are the planner's (AB_USES_…). Throws InputError where it can't be started.
  ApartWorker(const ApartOptions& options, std::uint32_t needs);

  /// Not before the job before has come to its end. Throws InputError where the process takes none.
  void begin(Job job);

  /// What became of the job, once it has come to its end. To be asked about five times a second; a
  /// longer time in between counts for little, since what stops this process stops its workers,
  /// too. Throws InputError where the trial could not be begun at all.
  std::optional<ApartFlight> look();

  /// Whether the process has ended or was ended, and takes no further job.
  bool is_over() const { return is_over_; }
  int result_fd() const { return process_.result_fd(); }  ///< for poll()
  pid_t pid() const { return process_.pid(); }

 private:
  ApartFlight answered();
  ApartFlight ended(Death death);

  ApartOptions options_;
  WorkerProcess process_;
  Job job_;
  std::chrono::steady_clock::time_point looked_;
  double busy_s_ = 0.0, silent_s_ = 0.0;  ///< since the job began, since the last sign of life
  bool is_over_ = false;
};

/// Waits until one of the workers may have news, a fifth of a second at most.
void wait_for_news(std::span<const ApartWorker* const> workers);

}  // namespace avoidbench
