#include <time.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "avoidbench/planner.hpp"

// A planner that uses a known amount of CPU time, in the thread that calls it or in others.
class Threads {
 public:
  static constexpr const char* name = "threads";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{avoidbench::choice_parameter(
      "how", "calling", "calling|three|behind|spin",
      "60 ms in the calling thread, in each of three threads, in one that goes on after the call, "
      "or a thread that never rests.")};

  Threads(const ab_setup& setup, const ab_host&) {
    how_ = avoidbench::Parameters<Threads>(setup).text("how");
    if (how_ == "behind" || how_ == "spin") {
      behind_ = std::jthread([this](const std::stop_token& stop) { work_behind(stop); });
    }
  }

  ~Threads() {
    behind_.request_stop();
    const std::lock_guard lock(mutex_);
    work_.notify_all();
  }

  void reset(const ab_mission&) {}

  std::optional<ab_command> plan(const ab_observation&) {
    if (how_ == "calling") use_60_ms();
    if (how_ == "three") {
      std::vector<std::jthread> threads;
      for (int i = 0; i < 3; ++i) threads.emplace_back(use_60_ms);
    }
    if (how_ == "behind") wait_or_begin();
    return avoidbench::make_velocity_command({}, 0.0);
  }

 private:
  static void use_60_ms() {
    const auto used_ns = [] {
      timespec now{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
      return 1'000'000'000LL * now.tv_sec + now.tv_nsec;
    };
    const long long end_ns = used_ns() + 60'000'000;
    while (used_ns() < end_ns) {
    }
  }

  /// Every other call waits for what the one before it began.
  void wait_or_begin() {
    std::unique_lock lock(mutex_);
    if (is_begun_) {
      work_.wait(lock, [this] { return is_done_; });
    }
    is_begun_ = !is_begun_;
    is_done_ = false;
    work_.notify_all();
  }

  void work_behind(const std::stop_token& stop) {
    while (how_ == "spin" && !stop.stop_requested()) {
    }
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      work_.wait(lock, [&] { return (is_begun_ && !is_done_) || stop.stop_requested(); });
      if (stop.stop_requested()) return;
      lock.unlock();
      use_60_ms();
      lock.lock();
      is_done_ = true;
      work_.notify_all();
    }
  }

  std::string how_;
  std::mutex mutex_;
  std::condition_variable work_;
  bool is_begun_ = false, is_done_ = false;
  std::jthread behind_;  // last: it uses the others
};

AVOIDBENCH_PLANNER(Threads)
