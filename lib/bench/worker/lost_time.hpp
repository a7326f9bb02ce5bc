#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <map>

namespace avoidbench {

/// How much of a planner's call the machine did not give it: while the whole process stood still,
/// stopped by a signal or with its machine, and while a thread that could run waited for a
/// processor. It does not count against the plan timeout, so that a slow planner is not stored as
/// one that hangs because other programs kept the processors busy.
class LostTime {
 public:
  /// Of a call that has lasted for `call_s`. To be asked ten times a second.
  double in_call_s(double call_s);
  /// The same with the time since the last look, and how long each thread has waited so far
  /// (processor_waits_ns(); asked for only in calls that last for more than a second).
  double in_call_s(double call_s, double look_s, const std::map<pid_t, std::uint64_t>& waits_ns);

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::map<pid_t, std::uint64_t> last_waits_ns_;
  double stopped_s_ = 0.0, waited_s_ = 0.0;
};

}  // namespace avoidbench
