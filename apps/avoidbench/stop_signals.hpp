#pragma once

#include <atomic>
#include <string_view>

/// Signals that end a run.
namespace avoidbench {

struct StopSignals {
  std::atomic<bool> stop{false};      ///< the first one came: what flies may end
  std::atomic<bool> stop_now{false};  ///< a second one: nothing is waited for
  std::atomic<int> number{0};         ///< of the last one that counted
  std::atomic<int> ignored{0};        ///< that a planner sent
};

/// From now on SIGINT, SIGTERM, SIGUSR1, SIGHUP unless it is ignored, and SIGXCPU of `ulimit -t`
/// are noted there and end the process by themselves only the third time; SIGHUP counts once. Those
/// that a process sends which descends from this one are ignored: a planner may not stop its run.
/// SIGPIPE is ignored.
const StopSignals& watch_stop_signals();

/// Says that on stderr and ends the program with the exit code of one that was told to stop.
[[noreturn]] void end_stopped(const StopSignals& signals, std::string_view message);

}  // namespace avoidbench
