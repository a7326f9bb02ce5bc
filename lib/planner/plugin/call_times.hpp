#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace avoidbench {

/// What a planner's calls took on the host.
struct CallTimes {
  std::int64_t count = 0;
  std::int64_t late_count = 0;  ///< whose wall time was longer than the plan period
  double wall_s = 0.0;  ///< of a usual call: the mean of a sweep's, or the median of some measured
  double cpu_s = 0.0;   ///< of all threads of the planner's process, not of other processes
  double most_wall_s = 0.0;  ///< NaN where not known
};

/// Why the planner could not fly so on a vehicle: too many calls are longer than the plan period,
/// or they take longer than the latency after which their commands act (0: no demand). "" where it
/// could. A period of 0 is left out of the text, and so is an empty name of the planner.
std::string lateness(const CallTimes& times, double plan_period_s, double latency_s,
                     std::string_view planner = "");

/// Why CPU times say too little: the wall time is far above them, since the planner sleeps, waits
/// for a GPU or another process, or the machine is overloaded. "" where they agree.
std::string hidden_time(const CallTimes& times, std::string_view planner = "");

}  // namespace avoidbench
