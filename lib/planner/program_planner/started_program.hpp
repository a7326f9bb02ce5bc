#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "program_planner/planner_source.hpp"
#include "program_planner/program_prints.hpp"
#include "program_planner/segment.hpp"

namespace avoidbench {

/// What a program did that no planner does: it ended, or its answer is none. What it printed last
/// is in the text.
class ProgramFault : public std::runtime_error {
 public:
  ProgramFault(const std::string& text, bool is_over, bool is_killed = false)
      : std::runtime_error(text), has_ended(is_over), was_killed(is_killed) {}
  bool has_ended;
  bool was_killed;  ///< by somebody else, maybe
};

/// A planner's program that runs. It has a process group of its own, standard input from nowhere,
/// a pipe for what it prints, the socket, the segment and no other descriptor; it ends with this
/// process. Not for two threads at once.
class StartedProgram {
 public:
  /// Throws InputError where it can't be started.
  explicit StartedProgram(const PlannerSource& source);
  /// Kills it with all that descends from it.
  ~StartedProgram();
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  /// Asks, and waits for as long as it takes. `write_body` appends the body to the segment and
  /// returns its offset. The answer stays as it is until the next one; its first bytes are an
  /// ab_process_answer of the right sequence and kind. Throws ProgramFault, and then the program is
  /// dead.
  const std::vector<std::byte>& ask(std::uint32_t kind,
                                    const std::function<std::uint64_t(Segment&)>& write_body);

  bool is_alive() const { return pid_ > 0; }
  /// Looks whether it lives, while nothing was asked.
  bool still_lives();
  /// Of all its threads since it started.
  double cpu_time_s() const;

 private:
  void start(const std::vector<std::string>& words, const std::string& folder);
  void wait_for_word(ab_process_word expected);
  bool wait_for_events(bool& has_word);
  bool has_ended() const;
  [[noreturn]] void fail_as_ended();
  [[noreturn]] void fail(const std::string& what);
  int kill();  ///< its status, as waitpid gives it

  std::string name_;
  Segment segment_;
  ProgramPrints prints_;
  pid_t pid_ = -1;
  int socket_ = -1, pid_fd_ = -1;
  clockid_t cpu_clock_ = 0;
  bool has_cpu_clock_ = false;
  std::uint32_t sequence_ = 0;
  std::vector<std::byte> answer_;
};

}  // namespace avoidbench
