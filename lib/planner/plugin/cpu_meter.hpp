#pragma once

#include <cstdint>

namespace avoidbench {

/// Whose a thread is: the host's, a library's (started while it was loaded) or an instance's.
using ThreadOwner = std::uint64_t;
constexpr ThreadOwner kHostThreads = 0;

ThreadOwner new_thread_owner();

/// Says whose the threads are that start from now on; those that started until now are whose they
/// were to be.
void threads_belong_to(ThreadOwner owner);

/// CPU time that a planner's instance uses: of the thread that calls it during calls; and of the
/// threads that it started, in its calls and between them, also of those that have ended. Not
/// counted: threads of the host, of other instances and other libraries, and processes that it
/// started. One instance's calls come one after the other.
///
/// The time of other threads is the process's less that of the threads that are not the instance's.
/// The kernel brings the process's up to date at its ticks, every 1 to 10 ms, so what a thread
/// computes in one call may be charged to the next one; below 5 µs it waits for more.
class CpuMeter {
 public:
  /// `library` owns threads that count, too.
  explicit CpuMeter(ThreadOwner library);
  ~CpuMeter();
  CpuMeter(const CpuMeter&) = delete;
  CpuMeter& operator=(const CpuMeter&) = delete;

  void begin_call();
  double end_call();  ///< CPU time of this call and of the time since the last one's end, s
  /// Forgets what other threads used until now: it is no part of the next call.
  void settle();

 private:
  double others_s() const;

  ThreadOwner library_, self_;
  double call_began_s_ = 0.0;  ///< CPU time of the calling thread
  double charged_s_ = 0.0;     ///< what others_s() was when it was last charged
};

}  // namespace avoidbench
