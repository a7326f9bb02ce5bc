#ifndef ROS_DURATION_H
#define ROS_DURATION_H

#include <cstdint>
#include <iosfwd>
#include <stdexcept>

namespace ros_shim {

/// Rounded to the nearest; throws std::runtime_error for what is not finite or too large.
std::int64_t nanoseconds_of(double seconds);
void sleep_for_ns(std::int64_t nanoseconds);
bool is_running();

}  // namespace ros_shim

namespace ros {

class Rate;
class WallRate;

/// `nsec` lies in [0, 1e9) always: -0.1 s is -1 s and 900000000 ns.
template <class T>
class DurationBase {
 public:
  std::int32_t sec, nsec;

  DurationBase() : sec(0), nsec(0) {}
  DurationBase(std::int32_t sec_, std::int32_t nsec_) : sec(0), nsec(0) {
    fromNSec(static_cast<std::int64_t>(sec_) * 1000000000 + nsec_);
  }
  explicit DurationBase(double seconds) : sec(0), nsec(0) { fromSec(seconds); }

  T& fromNSec(std::int64_t nanoseconds) {
    std::int64_t whole = nanoseconds / 1000000000, rest = nanoseconds % 1000000000;
    if (rest < 0) {
      rest += 1000000000;
      --whole;
    }
    if (whole > 0x7fffffffLL || whole < -0x80000000LL) {
      throw std::runtime_error("Duration is out of dual 32-bit range");
    }
    sec = static_cast<std::int32_t>(whole);
    nsec = static_cast<std::int32_t>(rest);
    return *static_cast<T*>(this);
  }
  T& fromSec(double seconds) { return fromNSec(ros_shim::nanoseconds_of(seconds)); }
  std::int64_t toNSec() const {
    return static_cast<std::int64_t>(sec) * 1000000000 + static_cast<std::int64_t>(nsec);
  }
  double toSec() const { return static_cast<double>(sec) + 1e-9 * static_cast<double>(nsec); }
  bool isZero() const { return sec == 0 && nsec == 0; }

  T operator+(const T& other) const { return T().fromNSec(toNSec() + other.toNSec()); }
  T operator-(const T& other) const { return T().fromNSec(toNSec() - other.toNSec()); }
  T operator-() const { return T().fromNSec(-toNSec()); }
  T operator*(double scale) const { return T(toSec() * scale); }
  T& operator+=(const T& other) { return fromNSec(toNSec() + other.toNSec()); }
  T& operator-=(const T& other) { return fromNSec(toNSec() - other.toNSec()); }
  T& operator*=(double scale) { return fromSec(toSec() * scale); }
  friend bool operator==(const T& a, const T& b) { return a.toNSec() == b.toNSec(); }
  friend bool operator!=(const T& a, const T& b) { return a.toNSec() != b.toNSec(); }
  bool operator<(const T& other) const { return toNSec() < other.toNSec(); }
  bool operator>(const T& other) const { return toNSec() > other.toNSec(); }
  bool operator<=(const T& other) const { return toNSec() <= other.toNSec(); }
  bool operator>=(const T& other) const { return toNSec() >= other.toNSec(); }
};

class Duration : public DurationBase<Duration> {
 public:
  Duration() = default;
  Duration(std::int32_t sec_, std::int32_t nsec_) : DurationBase<Duration>(sec_, nsec_) {}
  explicit Duration(double seconds) : DurationBase<Duration>(seconds) {}
  explicit Duration(const Rate& rate);
  bool sleep() const {
    ros_shim::sleep_for_ns(toNSec());
    return ros_shim::is_running();
  }
};

class WallDuration : public DurationBase<WallDuration> {
 public:
  WallDuration() = default;
  WallDuration(std::int32_t sec_, std::int32_t nsec_) : DurationBase<WallDuration>(sec_, nsec_) {}
  explicit WallDuration(double seconds) : DurationBase<WallDuration>(seconds) {}
  explicit WallDuration(const Rate& rate);
  bool sleep() const {
    ros_shim::sleep_for_ns(toNSec());
    return ros_shim::is_running();
  }
};

extern const Duration DURATION_MIN, DURATION_MAX;
std::ostream& operator<<(std::ostream& out, const Duration& duration);
std::ostream& operator<<(std::ostream& out, const WallDuration& duration);

}  // namespace ros

#endif
