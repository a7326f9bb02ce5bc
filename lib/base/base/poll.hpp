#pragma once

#include <chrono>
#include <functional>
#include <utility>

namespace avoidbench {

/// Lets who waits for long work end it: while one lives, work of the same thread that calls
/// poll_caller() calls `poll`, and what that throws ends the work. Of several in a thread the
/// newest counts.
class PollScope {
 public:
  explicit PollScope(std::function<void()> poll)
      : poll_(std::move(poll)), outer_(std::exchange(newest(), this)) {}
  ~PollScope() { newest() = outer_; }
  PollScope(const PollScope&) = delete;
  PollScope& operator=(const PollScope&) = delete;

  /// The one that counts in this thread; null: none.
  static PollScope*& newest() {
    thread_local PollScope* scope = nullptr;
    return scope;
  }

  void poll() {
    constexpr std::chrono::milliseconds kPeriod(10);
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kPeriod;
    poll_();
  }

 private:
  std::function<void()> poll_;
  std::chrono::steady_clock::time_point next_;
  PollScope* outer_;
};

inline bool is_polled() { return PollScope::newest() != nullptr; }

/// For loops of long work, each time round: polls at most every 10 ms, and costs some 30 ns in
/// between. Without a PollScope in this thread it does nothing.
inline void poll_caller() {
  if (PollScope* const scope = PollScope::newest()) scope->poll();
}

}  // namespace avoidbench
