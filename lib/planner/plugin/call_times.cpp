#include "plugin/call_times.hpp"

#include "base/number_text.hpp"

namespace avoidbench {
namespace {

// One call in twenty: a busy machine delays some calls of every planner.
constexpr double kMostLate = 0.05;
// Both: a busy machine doubles wall times, and a few milliseconds more may be its doing.
constexpr double kFarAbove = 3.0, kLeastHidden_s = 3e-3;

std::string ms(double time_s) { return significant_digits(1000.0 * time_s, 3) + " ms"; }

std::string calls_of(std::string_view planner) {
  return planner.empty() ? "calls" : "calls of " + std::string(planner);
}

}  // namespace

std::string lateness(const CallTimes& times, double plan_period_s, double latency_s,
                     std::string_view planner) {
  if (times.count == 0) return "";
  const bool is_late =
      static_cast<double>(times.late_count) > kMostLate * static_cast<double>(times.count);
  if (is_late) {
    return std::to_string(times.late_count) + " of " + std::to_string(times.count) + " " +
           calls_of(planner) + " took longer than the plan period" +
           (plan_period_s > 0.0 ? " of " + ms(plan_period_s) : "") + " (wall time of one " +
           ms(times.wall_s) + ")";
  }
  // Who keeps the period may still be slower than the simulated planner is.
  if (latency_s > 0.0 && times.wall_s > latency_s) {
    return calls_of(planner) + " took " + ms(times.wall_s) +
           " of wall time, longer than the latency of " + ms(latency_s);
  }
  return "";
}

std::string hidden_time(const CallTimes& times, std::string_view planner) {
  const bool is_hidden =
      times.wall_s > kFarAbove * times.cpu_s && times.wall_s - times.cpu_s > kLeastHidden_s;
  if (times.count == 0 || !is_hidden) return "";
  return calls_of(planner) + " took " + ms(times.wall_s) + " of wall time, but " + ms(times.cpu_s) +
         " of CPU time: what the planner waits for (a sleep, a GPU, other processes) is not in its "
         "processing time (nor is waiting for a CPU, on a busy machine)";
}

}  // namespace avoidbench
