#ifndef ROS_TIMER_H
#define ROS_TIMER_H

#include <functional>
#include <memory>
#include <utility>

#include "ros/rate.h"
#include "ros/time.h"
#include "ros_shim/pointer.h"
#include "ros_shim/runtime.h"

namespace ros {

template <class T, class D>
struct BasicTimerEvent {
  T last_expected, last_real, current_expected, current_real, last_expired;
  /// A callback takes no simulated time.
  struct {
    WallDuration last_duration;
  } profile;
};
using TimerEvent = BasicTimerEvent<Time, Duration>;
using WallTimerEvent = BasicTimerEvent<WallTime, WallDuration>;
using SteadyTimerEvent = BasicTimerEvent<SteadyTime, WallDuration>;
#ifdef ROS_SHIM_HAS_BOOST
using TimerCallback = boost::function<void(const TimerEvent&)>;
using WallTimerCallback = boost::function<void(const WallTimerEvent&)>;
using SteadyTimerCallback = boost::function<void(const SteadyTimerEvent&)>;
#else
using TimerCallback = std::function<void(const TimerEvent&)>;
using WallTimerCallback = std::function<void(const WallTimerEvent&)>;
using SteadyTimerCallback = std::function<void(const SteadyTimerEvent&)>;
#endif

/// Ticks on simulated time. It stops when its last copy goes.
template <class T, class D>
class BasicTimer {
 public:
  using Event = BasicTimerEvent<T, D>;

  BasicTimer() = default;
  /// For NodeHandle::createTimer.
  template <class Callback>
  BasicTimer(const D& period, Callback callback, bool oneshot, bool autostart)
      : held_(std::make_shared<Held>(ros_shim::make_timer(
            period.toNSec(), oneshot, [callback](const ros_shim::TimerTick& tick) mutable {
              Event event;
              event.last_expected.fromNSec(tick.last_expected_ns);
              event.last_real.fromNSec(tick.last_real_ns);
              event.current_expected.fromNSec(tick.expected_ns);
              event.current_real.fromNSec(tick.real_ns);
              event.last_expired = event.last_real;
              callback(event);
            }))) {
    if (autostart) start();
  }

  void start() {
    if (held_) ros_shim::start_timer(held_->timer);
  }
  void stop() {
    if (held_) ros_shim::stop_timer(held_->timer);
  }
  void setPeriod(const D& period, bool reset = true) {
    if (held_) ros_shim::set_timer_period(held_->timer, period.toNSec(), reset);
  }
  bool hasPending() { return held_ && ros_shim::has_pending_tick(held_->timer); }
  bool hasStarted() const { return held_ != nullptr; }
  bool isValid() { return held_ != nullptr; }
  operator void*() const { return held_ ? held_.get() : nullptr; }
  bool operator==(const BasicTimer& other) const { return held_ == other.held_; }
  bool operator!=(const BasicTimer& other) const { return held_ != other.held_; }

 private:
  struct Held {
    int timer;
    explicit Held(int timer_) : timer(timer_) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() { ros_shim::remove_timer(timer); }
  };
  std::shared_ptr<Held> held_;
};

using Timer = BasicTimer<Time, Duration>;
using WallTimer = BasicTimer<WallTime, WallDuration>;
using SteadyTimer = BasicTimer<SteadyTime, WallDuration>;

struct TimerOptions {
  TimerOptions() = default;
  TimerOptions(Duration period_, TimerCallback callback_, void*, bool oneshot_ = false,
               bool autostart_ = true)
      : period(period_), callback(std::move(callback_)), oneshot(oneshot_), autostart(autostart_) {}
  Duration period{0.1};
  TimerCallback callback;
  bool oneshot = false, autostart = true;
};

}  // namespace ros

#endif
