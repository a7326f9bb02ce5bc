#include "plugin/cpu_meter.hpp"

#include <dirent.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <vector>

namespace avoidbench {
namespace {

/// Reading the clocks one after the other is off by less.
constexpr double kLeastCharge_s = 5e-6;

/// CPU time on the clock, or -1 if there is none.
double cpu_time_s(clockid_t clock) {
  timespec now{};
  if (::clock_gettime(clock, &now) != 0) return -1.0;
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The CPU clock of a thread of this process, as pthread_getcpuclockid makes it (a part of Linux's
/// interface); clock_gettime refuses it after the thread's end.
clockid_t thread_clock(pid_t thread) {
  constexpr unsigned kPerThread = 4, kScheduled = 2;
  return static_cast<clockid_t>((~static_cast<unsigned>(thread) << 3U) | kPerThread | kScheduled);
}

struct KnownThread {
  pid_t id = 0;
  ThreadOwner owner = kHostThreads;
  double used_s = 0.0;  ///< when last looked at
  bool has_ended = false;
};

/// The threads of this process and whose they are.
/// One for the process, since threads are. Each thread has one owner for its life; one that ended
/// keeps the time that was last seen, so that totals never fall.
class ThreadLedger {
 public:
  /// Threads that are not known yet become those of the owner that was given last.
  void set_current(ThreadOwner owner) {
    const std::lock_guard lock(mutex_);
    // The usual case: one planner's calls follow each other.
    if (owner == current_) return;
    adopt_unknown();
    current_ = owner;
  }

  /// The host's own.
  void add_calling_thread() {
    const std::lock_guard lock(mutex_);
    const pid_t id = ::gettid();
    // It may have been taken for a planner's when the threads were listed.
    std::erase_if(threads_, [id](const KnownThread& thread) { return thread.id == id; });
    threads_.push_back({.id = id, .owner = kHostThreads});
  }

  /// CPU time of the known threads that are of none of these.
  double used_by_others_s(ThreadOwner one, ThreadOwner other) {
    const std::lock_guard lock(mutex_);
    double total_s = 0.0;
    for (KnownThread& thread : threads_) {
      if (thread.owner == one || thread.owner == other) continue;
      if (!thread.has_ended) {
        const double now_s = cpu_time_s(thread_clock(thread.id));
        // A clock that went back is that of another thread with the same number.
        thread.has_ended = now_s < thread.used_s;
        if (!thread.has_ended) thread.used_s = now_s;
      }
      total_s += thread.used_s;
    }
    return total_s;
  }

 private:
  bool knows(pid_t id) const {
    return std::any_of(threads_.begin(), threads_.end(), [id](const KnownThread& thread) {
      // The number of one that ended may be a new one's.
      return thread.id == id && !thread.has_ended;
    });
  }

  void adopt_unknown() {
    // First of all, since a number that is free again may be a new thread's by now.
    for (KnownThread& thread : threads_) {
      if (!thread.has_ended && cpu_time_s(thread_clock(thread.id)) < 0.0) thread.has_ended = true;
    }
    DIR* folder = ::opendir("/proc/self/task");
    if (folder == nullptr) return;
    while (const dirent* entry = ::readdir(folder)) {
      const auto id = static_cast<pid_t>(std::atol(entry->d_name));
      if (id > 0 && !knows(id)) threads_.push_back({.id = id, .owner = current_});
    }
    ::closedir(folder);
  }

  std::mutex mutex_;
  std::vector<KnownThread> threads_;
  ThreadOwner current_ = kHostThreads;
};

ThreadLedger& ledger() {
  static ThreadLedger the_ledger;
  return the_ledger;
}

}  // namespace

ThreadOwner new_thread_owner() {
  static std::atomic<ThreadOwner> last{kHostThreads};
  return ++last;
}

void threads_belong_to(ThreadOwner owner) { ledger().set_current(owner); }

CpuMeter::CpuMeter(ThreadOwner library) : library_(library), self_(new_thread_owner()) {}

CpuMeter::~CpuMeter() { threads_belong_to(kHostThreads); }

void CpuMeter::begin_call() {
  // Once a thread: asking the ledger at each call would cost more than short calls do.
  static thread_local const bool is_known = (ledger().add_calling_thread(), true);
  static_cast<void>(is_known);
  threads_belong_to(self_);
  // Last, so that the ledger's own work is not the call's.
  call_began_s_ = cpu_time_s(CLOCK_THREAD_CPUTIME_ID);
}

double CpuMeter::end_call() {
  double used_s = cpu_time_s(CLOCK_THREAD_CPUTIME_ID) - call_began_s_;
  const double others_s = this->others_s();
  // Less is kept for a later call, not lost.
  if (others_s - charged_s_ > kLeastCharge_s) {
    used_s += others_s - charged_s_;
    charged_s_ = others_s;
  }
  return used_s;
}

void CpuMeter::settle() { charged_s_ = others_s(); }

double CpuMeter::others_s() const {
  const double process_s = cpu_time_s(CLOCK_PROCESS_CPUTIME_ID);
  return process_s - ledger().used_by_others_s(library_, self_);
}

}  // namespace avoidbench
