#include "plugin/call_clock.hpp"

#include <unistd.h>

#include <chrono>

namespace avoidbench {
namespace {

std::int64_t monotonic_ns() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

void CallClock::begin() {
  process_ = ::getpid();
  began_ns_ = monotonic_ns();
}

void CallClock::end() {
  // A child that the planner forked comes back here as if it were the worker: it ends, quietly.
  if (::getpid() != process_) ::_exit(0);
  began_ns_ = 0;
}

double CallClock::running_s() const {
  const std::int64_t began_ns = began_ns_;
  return began_ns == 0 ? 0.0 : 1e-9 * static_cast<double>(monotonic_ns() - began_ns);
}

}  // namespace avoidbench
