#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "process/print_capture.hpp"
#include "worker/flight_journal.hpp"
#include "worker/message.hpp"

namespace avoidbench {

/// How a process ended, in words: "signal 11 (Segmentation fault)", "exit code 3".
struct ProcessEnd {
  std::string text;
  int exit_code = -1;         ///< -1: by a signal
  int signal = 0;             ///< 0: not by one
  bool is_of_others = false;  ///< somebody else's signal, or no planner was loaded yet
};

/// A child process that speaks Message over two pipes and makes notes on a third one, started by
/// posix_spawn (threads of libraries do not survive a fork). What it prints is captured, and it may
/// note how far a flight has come. Move-only; kills the child when destroyed.
/// Nothing here waits for the child except wait() and kill(): it may send half an answer, nothing
/// or rubbish, and the parent has other children. All descriptors are non-blocking and closed on
/// exec. After a failure of send() or receive() only wait(), notes() and kill() make sense.
class WorkerProcess {
 public:
  /// Starts `command` with the file descriptors 3 (jobs), 4 (results), 5 (notes) and 6 (the
  /// FlightJournal; -1: none) appended as arguments.
  /// Throws InputError where it can't be started.
  explicit WorkerProcess(const std::vector<std::string>& command);
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&& other) noexcept;

  pid_t pid() const { return pid_; }

  /// Begins to send a job, whose answer has at most so many bytes; never waits. `has_pieces`: other
  /// messages, each of as many bytes at most, come before the answer. False: it is gone.
  bool send(const Message& job, std::size_t most_answer_bytes, bool has_pieces = false);
  /// Sends more of the job. False: it is gone.
  bool send_more();
  bool has_more_to_send() const { return !unsent_.empty(); }

  /// What has come of an answer.
  enum class Answer { incomplete, whole, malformed, gone };
  /// Takes what there is; never waits. Whole: answer() has it, a piece or the answer.
  Answer receive();
  /// Takes out the whole answer; nothing where its text is no JSON object.
  std::optional<Message> answer() { return inbox_.take(); }
  /// How much of an answer has come.
  std::size_t answer_bytes() const { return inbox_.size(); }

  int job_fd() const { return job_fd_; }  ///< for poll(), both
  int result_fd() const { return result_fd_; }

  /// Reads the notes made since the last call; whether there were any, as there are every second
  /// from a child that lives. Keeps those that are text.
  bool listen();
  const std::string& notes() const { return notes_; }

  /// What was printed since the last job was sent; also of a child that has ended.
  std::string printed() const { return prints_.text(); }
  /// How far its flight had come when it ended: see FlightJournal::flown().
  std::optional<TrialRecord> flown() const { return journal_.flown(); }

  /// Whether the child has ended, though what it started may hold its pipes open.
  bool has_ended() const;

  /// How a child ended whose results do not come any more. One that lives on, since a planner broke
  /// its pipes, is killed after a second: with the exit code of a worker that sees so itself.
  ProcessEnd wait();

  /// Lets a child go on that a signal has stopped. False where none has.
  bool go_on();

  void kill();

 private:
  void close_all();
  int ended_within(double seconds);  ///< status of the child, or -1: it lives

  pid_t pid_ = -1;
  int job_fd_ = -1, result_fd_ = -1, notes_fd_ = -1;
  std::vector<std::byte> unsent_;
  MessageInbox inbox_;
  std::string notes_;
  bool was_heard_ = false;  ///< from the child, ever: it was ready to take a job
  PrintCapture prints_;
  FlightJournal journal_;
};

}  // namespace avoidbench
