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
  int signal = 0;      ///< 0: not by one
};

/// A child process that speaks Message over two pipes and makes notes on a third one, started by
/// posix_spawn (threads of libraries do not survive a fork). Move-only; kills the child when
/// destroyed.
class WorkerProcess {
 public:
  /// Starts `command` with the file descriptors 3 (jobs), 4 (results) and 5 (notes) appended as
  /// arguments.
  /// Throws InputError where it can't be started.
  explicit WorkerProcess(const std::vector<std::string>& command);
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&& other) noexcept;

  bool send(const Message& message);            ///< false: it is gone
  std::optional<Message> receive();             ///< waits; nothing: it is gone
  int result_fd() const { return result_fd_; }  ///< for poll()

  /// Reads the notes made since the last call; whether there were any, as there are every second
  /// from a child that lives. Keeps those that are text.
  bool listen();
  const std::string& notes() const { return notes_; }

  /// How a child ended whose results do not come any more. One that lives on, since a planner broke
  /// its pipes, is killed after a second: with the exit code of a worker that sees so itself.
  ProcessEnd wait();

  void kill();

 private:
  void close_all();
  int ended_within(double seconds);  ///< status of the child, or -1: it lives

  pid_t pid_ = -1;
  int job_fd_ = -1, result_fd_ = -1, notes_fd_ = -1;
  std::string notes_;
};

}  // namespace avoidbench
