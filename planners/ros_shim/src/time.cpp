#include "ros/time.h"

#include <cmath>
#include <iomanip>
#include <ostream>
#include <stdexcept>

#include "ros/rate.h"

namespace ros_shim {

std::int64_t nanoseconds_of(double seconds) {
  if (!(std::abs(seconds) < 9.0e9))
    throw std::runtime_error("a time of no finite number of seconds");
  // Whole seconds apart, so that the rest keeps its digits.
  const double whole = std::floor(seconds);
  return static_cast<std::int64_t>(whole) * 1000000000 +
         static_cast<std::int64_t>(std::round((seconds - whole) * 1e9));
}

}  // namespace ros_shim

namespace ros {
namespace {

/// Seconds, a dot and nine digits, as in ROS.
std::ostream& write(std::ostream& out, std::int64_t sec, std::uint64_t nsec) {
  const char fill = out.fill('0');
  out << sec << '.' << std::setw(9) << nsec;
  out.fill(fill);
  return out;
}

std::ostream& write_duration(std::ostream& out, std::int64_t nanoseconds) {
  if (nanoseconds < 0) out << '-';
  const std::uint64_t size = nanoseconds < 0 ? 0U - static_cast<std::uint64_t>(nanoseconds)
                                             : static_cast<std::uint64_t>(nanoseconds);
  return write(out, static_cast<std::int64_t>(size / 1000000000U), size % 1000000000U);
}

}  // namespace

const Time TIME_MIN(0, 1);
const Time TIME_MAX(0xffffffffU, 999999999U);
const Duration DURATION_MIN(-0x7fffffff - 1, 0);
const Duration DURATION_MAX(0x7fffffff, 999999999);

std::ostream& operator<<(std::ostream& out, const Time& time) {
  return write(out, time.sec, time.nsec);
}
std::ostream& operator<<(std::ostream& out, const WallTime& time) {
  return write(out, time.sec, time.nsec);
}
std::ostream& operator<<(std::ostream& out, const SteadyTime& time) {
  return write(out, time.sec, time.nsec);
}
std::ostream& operator<<(std::ostream& out, const Duration& duration) {
  return write_duration(out, duration.toNSec());
}
std::ostream& operator<<(std::ostream& out, const WallDuration& duration) {
  return write_duration(out, duration.toNSec());
}

bool Rate::sleep() {
  const Time end = start_ + expected_, now = Time::now();
  actual_ = now - start_;
  if (end <= now) {
    // Late by a whole period: begin anew.
    start_ = now > end + expected_ ? now : end;
    return false;
  }
  start_ = end;
  Time::sleepUntil(end);
  actual_ = Time::now() - (end - expected_);
  return true;
}

}  // namespace ros
