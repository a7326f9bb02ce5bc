#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <ctime>
#include <type_traits>

#include "avoidbench/repeatable.hpp"
#include "avoidbench/repeatable/state.hpp"

namespace avoidbench {
namespace {

constexpr std::int64_t kSecond_ns = 1000000000;

using repeatable::state;

/// Of the instance whose call this thread is in.
thread_local repeatable::State* of_call = nullptr;

std::int64_t nanoseconds_of(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

std::timespec timespec_of(std::int64_t time_ns) {
  std::timespec time{};
  time.tv_sec = static_cast<std::time_t>(time_ns / kSecond_ns);
  time.tv_nsec = static_cast<long>(time_ns % kSecond_ns);
  return time;
}

std::int64_t nanoseconds_of(const std::timespec& time) {
  return static_cast<std::int64_t>(time.tv_sec) * kSecond_ns + time.tv_nsec;
}

bool is_valid(const std::timespec& time) {
  return time.tv_sec >= 0 && time.tv_nsec >= 0 && time.tv_nsec < kSecond_ns;
}

void sleep_ns(std::int64_t duration_ns) {
  if (duration_ns <= 0) return;
  if (auto* const sleep = state().sleep_for_ns.load()) {
    sleep(duration_ns);
  } else {
    state().next_ns += duration_ns;
  }
}

void begin(repeatable::State& of, std::int64_t time_ns, std::int64_t step_ns, std::uint64_t seed) {
  of.next_ns = time_ns;
  of.step_ns = step_ns;
  of.random = repeatable::Random(1);
  of.device = seed;
}

void go_on(repeatable::State& of, std::int64_t time_ns) {
  std::int64_t before = of.next_ns;
  while (before < time_ns && !of.next_ns.compare_exchange_weak(before, time_ns)) {
  }
}

}  // namespace

repeatable::State& repeatable::state() {
  static State of_library;
  return of_call != nullptr ? *of_call : of_library;
}

void begin_repeatable_ns(std::int64_t time_ns, std::int64_t step_ns, std::uint64_t seed) {
  begin(state(), time_ns, step_ns, seed);
}

void set_clocks_ns(std::int64_t time_ns) { go_on(state(), time_ns); }

std::int64_t look_at_clock_ns() { return state().next_ns.fetch_add(state().step_ns); }

void set_sleep(void (*sleep_for_ns)(std::int64_t)) { state().sleep_for_ns = sleep_for_ns; }

Repeatable::Repeatable() : state_(std::make_unique<repeatable::State>()) {}
Repeatable::~Repeatable() = default;

Repeatable::InUse::InUse(repeatable::State& state) : before_(of_call) { of_call = &state; }
Repeatable::InUse::~InUse() { of_call = before_; }

Repeatable::InUse Repeatable::begin(const ab_mission& mission, double step_us) {
  avoidbench::begin(*state_, 0, nanoseconds_of(1e-6 * step_us), mission.seed);
  return InUse(*state_);
}

Repeatable::InUse Repeatable::go_on(const ab_observation& seen) {
  avoidbench::go_on(*state_, nanoseconds_of(seen.time_s));
  return InUse(*state_);
}

}  // namespace avoidbench

// Definitions in the planner's own library, which its linker takes before those of the C and the
// C++ library; declared by the linker's names, so that their headers' declarations say nothing of
// who sees them. Hidden: the host and other libraries keep their clocks.
#define AB_IN_PLACE_OF(symbol) __asm__(symbol) __attribute__((visibility("hidden")))

extern "C" {

int repeatable_clock_gettime(clockid_t, std::timespec*) AB_IN_PLACE_OF("clock_gettime");
int repeatable_timespec_get(std::timespec*, int) AB_IN_PLACE_OF("timespec_get");
int repeatable_gettimeofday(timeval*, void*) AB_IN_PLACE_OF("gettimeofday");
std::time_t repeatable_time(std::time_t*) AB_IN_PLACE_OF("time");
std::clock_t repeatable_clock() AB_IN_PLACE_OF("clock");
int repeatable_nanosleep(const std::timespec*, std::timespec*) AB_IN_PLACE_OF("nanosleep");
int repeatable_clock_nanosleep(clockid_t, int, const std::timespec*, std::timespec*)
    AB_IN_PLACE_OF("clock_nanosleep");
int repeatable_usleep(useconds_t) AB_IN_PLACE_OF("usleep");
unsigned repeatable_sleep(unsigned) AB_IN_PLACE_OF("sleep");
// Of system_clock::now() and steady_clock::now(), whose time points are a count of nanoseconds.
static_assert(std::is_same_v<std::chrono::system_clock::duration, std::chrono::nanoseconds>);
std::int64_t repeatable_system_clock_now() AB_IN_PLACE_OF("_ZNSt6chrono3_V212system_clock3nowEv");
std::int64_t repeatable_steady_clock_now() AB_IN_PLACE_OF("_ZNSt6chrono3_V212steady_clock3nowEv");

int repeatable_clock_gettime(clockid_t, std::timespec* time) {
  *time = avoidbench::timespec_of(avoidbench::look_at_clock_ns());
  return 0;
}

int repeatable_timespec_get(std::timespec* time, int base) {
  *time = avoidbench::timespec_of(avoidbench::look_at_clock_ns());
  return base;
}

int repeatable_gettimeofday(timeval* time, void*) {
  const std::int64_t microseconds = avoidbench::look_at_clock_ns() / 1000;
  time->tv_sec = static_cast<std::time_t>(microseconds / 1000000);
  time->tv_usec = static_cast<suseconds_t>(microseconds % 1000000);
  return 0;
}

std::time_t repeatable_time(std::time_t* to) {
  const auto seconds =
      static_cast<std::time_t>(avoidbench::look_at_clock_ns() / avoidbench::kSecond_ns);
  if (to != nullptr) *to = seconds;
  return seconds;
}

std::clock_t repeatable_clock() {
  static_assert(CLOCKS_PER_SEC == 1000000);
  return static_cast<std::clock_t>(avoidbench::look_at_clock_ns() / 1000);
}

int repeatable_nanosleep(const std::timespec* duration, std::timespec*) {
  if (!avoidbench::is_valid(*duration)) {
    errno = EINVAL;
    return -1;
  }
  avoidbench::sleep_ns(avoidbench::nanoseconds_of(*duration));
  return 0;
}

int repeatable_clock_nanosleep(clockid_t, int flags, const std::timespec* time, std::timespec*) {
  if (!avoidbench::is_valid(*time)) return EINVAL;
  const std::int64_t time_ns = avoidbench::nanoseconds_of(*time);
  const bool is_end = (flags & TIMER_ABSTIME) != 0;
  avoidbench::sleep_ns(is_end ? time_ns - avoidbench::look_at_clock_ns() : time_ns);
  return 0;
}

int repeatable_usleep(useconds_t microseconds) {
  avoidbench::sleep_ns(static_cast<std::int64_t>(microseconds) * 1000);
  return 0;
}

unsigned repeatable_sleep(unsigned seconds) {
  avoidbench::sleep_ns(static_cast<std::int64_t>(seconds) * avoidbench::kSecond_ns);
  return 0;
}

std::int64_t repeatable_system_clock_now() { return avoidbench::look_at_clock_ns(); }
std::int64_t repeatable_steady_clock_now() { return avoidbench::look_at_clock_ns(); }
}
