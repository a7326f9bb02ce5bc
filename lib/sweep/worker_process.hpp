#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "sweep/message.hpp"

namespace avoidbench {

/// Begins this program anew with its own arguments in the environment that worker processes have,
/// so that planners give the same bits here as in a sweep; returns where it is in it already, or
/// where that can't be done. Call it before anything was done that must not be done twice.
void enter_worker_environment();

/// How a process ended, in words: "signal 11 (Segmentation fault)", "exit code 3".
struct ProcessEnd {
  std::string text;
  int exit_code = -1;  ///< -1: by a signal
};

/// A child process that speaks Message over two pipes, started by posix_spawn (threads of libraries
/// do not survive a fork). Move-only; kills the child when destroyed.
class WorkerProcess {
 public:
  /// Starts `command` with the file descriptors 3 (jobs) and 4 (results) appended as arguments.
  /// Throws InputError where it can't be started.
  explicit WorkerProcess(const std::vector<std::string>& command);
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&& other) noexcept;

  bool send(const Message& message);            ///< false: it is gone
  std::optional<Message> receive();             ///< waits; nothing: it is gone
  int result_fd() const { return result_fd_; }  ///< for poll()

  /// Waits for the end of a child that is gone.
  ProcessEnd wait();

 private:
  void close_all();

  pid_t pid_ = -1;
  int job_fd_ = -1, result_fd_ = -1;
};

}  // namespace avoidbench
