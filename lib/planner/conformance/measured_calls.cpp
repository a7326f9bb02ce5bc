#include <algorithm>
#include <chrono>
#include <cstring>

#include "conformance/conformance.hpp"
#include "conformance/conformance_flight.hpp"
#include "conformance/own_process.hpp"
#include "process/isolated_run.hpp"

namespace avoidbench {
namespace {

/// Not the mean: on a busy machine some calls wait for a CPU.
double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Flies toward the wall again and again. The first flight is not counted: it loads and allocates.
/// Of a planner that needs a process for each trial there is no other.
CallTimes measured(const std::filesystem::path& file) {
  constexpr auto kEnough = std::chrono::seconds(2);
  const PlannerLibrary library = PlannerLibrary::load(file);
  const int most_flights = needs_own_process(library) ? 1 : 10;
  Probe probe(library.table(), resolve_parameters(library.description(), {}));
  CallTimes times;
  if (!probe.is_created()) return times;
  std::vector<double> wall_s, cpu_s;
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < most_flights; ++i) {
    const bool is_first = i == 0 && most_flights > 1;
    for (const Reply& reply : probe.fly(wall_flight())) {
      if (is_first || !reply.is_plan) continue;
      ++times.count;
      times.late_count += reply.wall_time_s > measured_plan_period_s() ? 1 : 0;
      wall_s.push_back(reply.wall_time_s);
      cpu_s.push_back(reply.cpu_time_s);
      times.most_wall_s = std::max(times.most_wall_s, reply.wall_time_s);
    }
    // After whole flights, so that each of the twenty calls counts alike.
    if (!is_first && std::chrono::steady_clock::now() - began > kEnough) break;
  }
  times.wall_s = median(wall_s);
  times.cpu_s = median(cpu_s);
  return times;
}

}  // namespace

double measured_plan_period_s() { return conformance_setup().plan_period_s; }

std::optional<CallTimes> measure_calls_isolated(const std::filesystem::path& file,
                                                double time_limit_s) {
  const IsolatedEnd run = run_isolated(
      [&](IsolatedOutput& output) {
        const CallTimes times = measured(file);
        // Both sides are one program, forked, so that a struct's bytes mean the same.
        std::string bytes(sizeof times, '\0');
        std::memcpy(bytes.data(), &times, sizeof times);
        output.write(bytes);
      },
      time_limit_s);
  if (!run.problem.empty() || run.output.size() != sizeof(CallTimes)) return std::nullopt;
  CallTimes times;
  std::memcpy(&times, run.output.data(), sizeof times);
  if (times.count == 0) return std::nullopt;
  return times;
}

}  // namespace avoidbench
