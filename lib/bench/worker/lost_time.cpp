#include "worker/lost_time.hpp"

#include <algorithm>

#include "process/process_tree.hpp"

namespace avoidbench {

double LostTime::in_call_s(double call_s) {
  constexpr double kShortCall_s = 1.0;  // shorter ones are never near a limit
  const auto now = std::chrono::steady_clock::now();
  const double look_s = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  return in_call_s(call_s, look_s,
                   call_s > kShortCall_s ? processor_waits_ns() : decltype(last_waits_ns_){});
}

double LostTime::in_call_s(double call_s, double look_s,
                           const std::map<pid_t, std::uint64_t>& waits_ns) {
  // Looks are a tenth of a second apart. A gap of a second or more means that the whole process
  // stood still; a busy machine alone makes shorter ones.
  constexpr double kLongestLook_s = 1.0;
  // A planner with many busy threads keeps them waiting by itself: ten times the limit ends it.
  constexpr double kMostWaited = 0.9;
  // A call shorter than the time since the last look is a new one.
  if (call_s < look_s) stopped_s_ = waited_s_ = 0.0;
  if (look_s > kLongestLook_s) {
    stopped_s_ += std::min(look_s, call_s);
  } else {
    double longest_s = 0.0;
    for (const auto& [thread, wait_ns] : waits_ns) {
      const auto last = last_waits_ns_.find(thread);
      if (last == last_waits_ns_.end() || wait_ns < last->second) continue;
      longest_s = std::max(longest_s, 1e-9 * static_cast<double>(wait_ns - last->second));
    }
    waited_s_ += std::min({longest_s, look_s, call_s});
  }
  last_waits_ns_ = waits_ns;
  return stopped_s_ + std::min(waited_s_, kMostWaited * std::max(0.0, call_s - stopped_s_));
}

}  // namespace avoidbench
