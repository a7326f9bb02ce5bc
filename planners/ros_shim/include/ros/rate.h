#ifndef ROS_RATE_H
#define ROS_RATE_H

#include "ros/time.h"

namespace ros {

/// sleep() waits until a period after its last end; where that has passed for a whole period, it
/// begins anew.
class Rate {
 public:
  Rate(double frequency_hz)
      : start_(Time::now()), expected_(1.0 / frequency_hz), actual_(Duration()) {}
  explicit Rate(const Duration& period) : start_(Time::now()), expected_(period) {}
  bool sleep();
  void reset() { start_ = Time::now(); }
  Duration cycleTime() const { return actual_; }
  Duration expectedCycleTime() const { return expected_; }

 private:
  Time start_;
  Duration expected_, actual_;
};

class WallRate {
 public:
  WallRate(double frequency_hz) : rate_(frequency_hz) {}
  explicit WallRate(const Duration& period) : rate_(period) {}
  bool sleep() { return rate_.sleep(); }
  void reset() { rate_.reset(); }
  WallDuration cycleTime() const { return WallDuration().fromNSec(rate_.cycleTime().toNSec()); }
  WallDuration expectedCycleTime() const {
    return WallDuration().fromNSec(rate_.expectedCycleTime().toNSec());
  }

 private:
  Rate rate_;
};

inline Duration::Duration(const Rate& rate) { fromNSec(rate.expectedCycleTime().toNSec()); }
inline WallDuration::WallDuration(const Rate& rate) { fromNSec(rate.expectedCycleTime().toNSec()); }

}  // namespace ros

#endif
