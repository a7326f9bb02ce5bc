#ifndef ROS_TIME_H
#define ROS_TIME_H

#include <cstdint>
#include <iosfwd>
#include <stdexcept>
#include <string>

#include "ros/duration.h"
#include "ros_shim/runtime.h"

namespace ros {

class TimeNotInitializedException : public std::runtime_error {
 public:
  TimeNotInitializedException() : std::runtime_error("ros::init() comes before ros::Time::now()") {}
};

template <class T, class D>
class TimeBase {
 public:
  std::uint32_t sec, nsec;

  TimeBase() : sec(0), nsec(0) {}
  TimeBase(std::uint32_t sec_, std::uint32_t nsec_) : sec(0), nsec(0) {
    fromNSec(static_cast<std::int64_t>(sec_) * 1000000000 + nsec_);
  }
  explicit TimeBase(double seconds) : sec(0), nsec(0) { fromSec(seconds); }

  T& fromNSec(std::int64_t nanoseconds) {
    if (nanoseconds < 0 || nanoseconds / 1000000000 > 0xffffffffLL) {
      throw std::runtime_error("Time is out of dual 32-bit range");
    }
    sec = static_cast<std::uint32_t>(nanoseconds / 1000000000);
    nsec = static_cast<std::uint32_t>(nanoseconds % 1000000000);
    return *static_cast<T*>(this);
  }
  T& fromSec(double seconds) { return fromNSec(ros_shim::nanoseconds_of(seconds)); }
  std::int64_t toNSec() const {
    return static_cast<std::int64_t>(sec) * 1000000000 + static_cast<std::int64_t>(nsec);
  }
  double toSec() const { return static_cast<double>(sec) + 1e-9 * static_cast<double>(nsec); }
  bool isZero() const { return sec == 0 && nsec == 0; }
  bool is_zero() const { return isZero(); }

  D operator-(const T& other) const {
    D difference;
    difference.fromNSec(toNSec() - other.toNSec());
    return difference;
  }
  T operator+(const D& duration) const { return T().fromNSec(toNSec() + duration.toNSec()); }
  T operator-(const D& duration) const { return T().fromNSec(toNSec() - duration.toNSec()); }
  T& operator+=(const D& duration) { return fromNSec(toNSec() + duration.toNSec()); }
  T& operator-=(const D& duration) { return fromNSec(toNSec() - duration.toNSec()); }
  friend bool operator==(const T& a, const T& b) { return a.toNSec() == b.toNSec(); }
  friend bool operator!=(const T& a, const T& b) { return a.toNSec() != b.toNSec(); }
  bool operator<(const T& other) const { return toNSec() < other.toNSec(); }
  bool operator>(const T& other) const { return toNSec() > other.toNSec(); }
  bool operator<=(const T& other) const { return toNSec() <= other.toNSec(); }
  bool operator>=(const T& other) const { return toNSec() >= other.toNSec(); }
};

/// The time of the simulation, in which a callback takes as long as its looks at clocks.
class Time : public TimeBase<Time, Duration> {
 public:
  Time() = default;
  Time(std::uint32_t sec_, std::uint32_t nsec_) : TimeBase<Time, Duration>(sec_, nsec_) {}
  explicit Time(double seconds) : TimeBase<Time, Duration>(seconds) {}
  static Time now() { return Time().fromNSec(ros_shim::clock_ns()); }
  static bool sleepUntil(const Time& end) {
    ros_shim::sleep_until_ns(end.toNSec());
    return ros_shim::is_running();
  }
  static void init() {}
  static void shutdown() {}
  static bool useSystemTime() { return false; }
  static bool isSimTime() { return true; }
  static bool isSystemTime() { return false; }
  static bool isValid() { return true; }
  static bool waitForValid() { return true; }
};

/// The same time: a wall's clock would make flights differ.
class WallTime : public TimeBase<WallTime, WallDuration> {
 public:
  WallTime() = default;
  WallTime(std::uint32_t sec_, std::uint32_t nsec_)
      : TimeBase<WallTime, WallDuration>(sec_, nsec_) {}
  explicit WallTime(double seconds) : TimeBase<WallTime, WallDuration>(seconds) {}
  static WallTime now() { return WallTime().fromNSec(ros_shim::clock_ns()); }
  static bool sleepUntil(const WallTime& end) {
    ros_shim::sleep_until_ns(end.toNSec());
    return ros_shim::is_running();
  }
  static bool isSystemTime() { return true; }
};

class SteadyTime : public TimeBase<SteadyTime, WallDuration> {
 public:
  SteadyTime() = default;
  SteadyTime(std::uint32_t sec_, std::uint32_t nsec_)
      : TimeBase<SteadyTime, WallDuration>(sec_, nsec_) {}
  explicit SteadyTime(double seconds) : TimeBase<SteadyTime, WallDuration>(seconds) {}
  static SteadyTime now() { return SteadyTime().fromNSec(ros_shim::clock_ns()); }
};

extern const Time TIME_MIN, TIME_MAX;
std::ostream& operator<<(std::ostream& out, const Time& time);
std::ostream& operator<<(std::ostream& out, const WallTime& time);
std::ostream& operator<<(std::ostream& out, const SteadyTime& time);

}  // namespace ros

#include "ros/rate.h"

#endif
