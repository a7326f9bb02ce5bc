/* Makes planners that read clocks or use random numbers repeat in every run. Link
 * avoidbench::repeatable into the planner's library; in it and in what it links statically
 *   - clock_gettime, gettimeofday, time, clock, timespec_get and std::chrono's clocks return the
 *     trial's time, plus one step for each reading: a budget of computing time is a number of
 *     readings, on any machine;
 *   - nanosleep, clock_nanosleep, usleep, sleep and std::this_thread::sleep_for take no wall time,
 *     but advance these clocks;
 *   - rand and random return the C library's numbers, from the beginning in each trial;
 *     std::random_device returns numbers that depend on the trial's seed.
 * It has no effect outside the library. Not covered: libraries that are linked dynamically,
 * waits with a time limit, getrandom, and whatever else depends on when threads run.
 *
 *   void reset(const ab_mission& mission) {
 *     const auto in_use = repeatable_.begin(mission, compute_clock_us_);
 *     …
 *   }
 *   std::optional<ab_command> plan(const ab_observation& seen) {
 *     const auto in_use = repeatable_.go_on(seen);
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 */
#ifndef AVOIDBENCH_REPEATABLE_HPP
#define AVOIDBENCH_REPEATABLE_HPP

#include <cstdint>
#include <memory>

#include "avoidbench/planner.h"

namespace avoidbench {

/// The step as a planner's parameter: a trial's key holds it.
constexpr ab_parameter compute_clock_parameter(double preset_us = 1.0) {
  return {sizeof(ab_parameter),
          AB_NUMBER,
          "compute_clock_us",
          "us",
          "How much later each look at a clock finds it: what computing costs.",
          1e-3,
          1e6,
          preset_us,
          nullptr,
          nullptr};
}

namespace repeatable {
struct State;
}

/// Clocks and chance of an instance of the planner: what its calls see on the thread of the host.
/// Threads of the planner's own see those of the library, which no trial sets.
class Repeatable {
 public:
  /// As long as it is there, this thread sees them.
  class InUse {
   public:
    explicit InUse(repeatable::State& state);
    ~InUse();
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

   private:
    repeatable::State* before_;
  };

  Repeatable();
  ~Repeatable();
  Repeatable(const Repeatable&) = delete;
  Repeatable& operator=(const Repeatable&) = delete;

  /// A trial begins: clocks stand at 0, and chance follows from the mission's seed.
  [[nodiscard]] InUse begin(const ab_mission& mission, double step_us);
  /// Clocks go on to the call's time; where looks have brought them further, they stay there.
  [[nodiscard]] InUse go_on(const ab_observation& seen);

 private:
  std::unique_ptr<repeatable::State> state_;
};

// The same of the library, for one that is loaded once a trial.

/// Clocks stand at this time, and chance follows from the seed.
void begin_repeatable_ns(std::int64_t time_ns, std::int64_t step_ns, std::uint64_t seed);
/// As Repeatable::go_on().
void set_clocks_ns(std::int64_t time_ns);
/// One look at the clock.
std::int64_t look_at_clock_ns();
/// Who sleeps in the place of the planner, for that many nanoseconds; without it clocks go on.
void set_sleep(void (*sleep_for_ns)(std::int64_t duration_ns));

}  // namespace avoidbench

#endif
