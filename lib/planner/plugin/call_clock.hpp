#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>

namespace avoidbench {

/// When the planner's call that runs now began, for a watchdog in another thread.
class CallClock {
 public:
  void begin();
  /// Ends the process where it is not the one that began the call: a child that the planner forked
  /// came back from the call as well, and would go on as its parent does.
  void end();
  double running_s() const;  ///< wall time of the call under way; 0 between calls

 private:
  std::atomic<std::int64_t> began_ns_{0};
  pid_t process_ = 0;
};

/// A call under way for as long as it lives. `clock` may be null.
class TimedCall {
 public:
  explicit TimedCall(CallClock* clock) : clock_(clock) {
    if (clock_ != nullptr) clock_->begin();
  }
  ~TimedCall() {
    if (clock_ != nullptr) clock_->end();
  }
  TimedCall(const TimedCall&) = delete;
  TimedCall& operator=(const TimedCall&) = delete;

 private:
  CallClock* clock_;
};

}  // namespace avoidbench
