#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace avoidbench {

/// What an isolated run leaves for its parent: memory that both share. No file descriptor leads to
/// it, so that a planner that closes or writes to every one of them changes nothing, and it can't
/// be touched except during write().
class IsolatedOutput {
 public:
  /// Twenty trajectories of the longest kind fit (conformance). What is not written takes no
  /// memory.
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20U;

  IsolatedOutput();
  ~IsolatedOutput();
  IsolatedOutput(const IsolatedOutput&) = delete;
  IsolatedOutput& operator=(const IsolatedOutput&) = delete;

  /// Appends; false if there is no room for it. A copy of the process that a planner forked off
  /// ends here.
  bool write(std::string_view bytes);

  /// Makes the calling process the only one that writes.
  void claim();
  /// Says that the run came to its end.
  void finish();
  bool is_finished() const;
  std::string bytes() const;

 private:
  struct Shared;
  Shared* shared_ = nullptr;
  std::size_t written_ = 0;
  pid_t owner_ = 0;
};

/// How an isolated run ended.
struct IsolatedEnd {
  std::string output;  ///< what it wrote, also if it did not come to its end
  /// "" if it came to its end; else how it did not: "crashed by signal 6 (Aborted)", "ended the
  /// process with code 0", "did not return within 10 s".
  std::string problem;
  std::string last_words;  ///< last line that it printed, printable; "" if none or shown
};

/// What becomes of what an isolated run prints: kept for its last words, or shown on stderr.
enum class Prints { kept, shown };

/// Runs `work`, which calls code that is not trusted to return, in a forked child with a session,
/// working folder, signal handlers and standard streams of its own and no file descriptor of ours.
/// After its end or the time limit, and if this process ends, it and all its descendants are
/// killed. Throws InputError if there can't be a child.
///
/// A fork, not a new program: any program that links this room can do it. It takes with it only the
/// calling thread, so call it before threads of libraries that planners share (Embree's) are there.
IsolatedEnd run_isolated(const std::function<void(IsolatedOutput&)>& work, double time_limit_s,
                         Prints prints = Prints::kept);

}  // namespace avoidbench
