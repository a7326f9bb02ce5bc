#include "conformance/repeats.hpp"

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <stop_token>
#include <string_view>
#include <thread>

#include "conformance/conformance_flight.hpp"
#include "conformance/own_process.hpp"
#include "conformance/shifted_clock.hpp"
#include "process/isolated_run.hpp"

namespace avoidbench {
namespace {

/// What may change between two runs of a benchmark and must change nothing.
struct Circumstances {
  const char* words;
  const char* cause;  ///< of what differs then
  bool shifts_clocks = false;
  std::chrono::milliseconds pause{0};  ///< before each call
  int busy_threads = 0;                ///< beside it, all on one CPU
};

using namespace std::chrono_literals;
constexpr Circumstances kAlone{"", ""};
constexpr Circumstances kOthers[] = {
    {"in a second process", "it depends on chance, time, threads or addresses"},
    // Each budget and time-out is over then; a busy machine ends some of them now and then.
    {"where each look at a clock finds it one second later", "it depends on time", true},
    // Longer than what a thread beside the calls needs for a piece of work.
    {"with 20 ms before each call", "it depends on time or on threads that run on between calls",
     false, 20ms},
    {"on one CPU with three busy threads", "it depends on time, threads or the number of CPUs",
     false, 0ms, 3},
};

/// Keeps the calling thread, and what it starts, to one CPU.
void keep_to_one_cpu() {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(std::max(::sched_getcpu(), 0)), &one);
  // Where it is refused, all CPUs are left to it, and the load is what it is.
  ::sched_setaffinity(0, sizeof one, &one);
}

/// Threads that never rest, until they are destroyed.
std::vector<std::jthread> busy_threads(int count) {
  std::vector<std::jthread> threads;
  for (int i = 0; i < count; ++i) {
    threads.emplace_back([](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
      }
    });
  }
  return threads;
}

struct Flown {
  std::vector<Reply> replies;  ///< none where the circumstances can't be made
  std::string clocks;          ///< clocks_looked_at()
  std::string problem;         ///< why there was no end
};

/// In a process of its own, which ends after it.
std::string fly_here(const std::filesystem::path& file, const Circumstances& circumstances) {
  // Of a program's clock nothing is known here.
  if (circumstances.shifts_clocks && PlannerLibrary::is_program(file)) return "";
  if (circumstances.busy_threads > 0) keep_to_one_cpu();
  const PlannerLibrary library = PlannerLibrary::load(file);
  if (circumstances.shifts_clocks && !shift_clocks(file)) return "";
  Probe probe(library.table(), resolve_parameters(library.description(), {}));
  if (!probe.is_created()) return "";
  // Not before: to load and to start a program would take several times as long.
  const std::vector<std::jthread> busy = busy_threads(circumstances.busy_threads);
  const ConformanceFlight flight = wall_flight();
  std::vector<Reply> replies{probe.reset(flight.mission)};
  for (const Frame& frame : flight.frames) {
    std::this_thread::sleep_for(circumstances.pause);
    replies.push_back(probe.plan(frame));
  }
  return clocks_looked_at() + '\n' + bytes_of(replies);
}

Flown fly(const std::filesystem::path& file, const Circumstances& circumstances) {
  const IsolatedEnd end = run_isolated(
      [&](IsolatedOutput& output) { output.write(fly_here(file, circumstances)); }, kFlightLimit_s);
  Flown flown{.replies = {}, .clocks = "", .problem = end.problem};
  const std::size_t line_end = end.output.find('\n');
  if (!end.problem.empty() || line_end == std::string::npos) return flown;
  flown.clocks = end.output.substr(0, line_end);
  flown.replies = replies_of(std::string_view(end.output).substr(line_end + 1));
  return flown;
}

}  // namespace

ConformanceResult repeats_rule() {
  return {"repeats",
          "Flown again in other processes, with other clocks, with pauses between calls and on a "
          "busy CPU it gives equal commands, bit for bit. (Clocks are those of libraries.)",
          false, ""};
}

std::string repeats_finding(const std::filesystem::path& file) {
  const Flown first = fly(file, kAlone);
  if (!first.problem.empty()) return "in a separate process it " + first.problem;
  // Why it can't be made is what another rule says.
  if (first.replies.empty()) return "";
  for (const Circumstances& other : kOthers) {
    const Flown again = fly(file, other);
    if (!again.problem.empty()) return std::string(other.words) + " it " + again.problem;
    if (again.replies.empty()) continue;
    const std::string difference = first_difference(first.replies, again.replies);
    if (difference.empty()) continue;
    const std::string clocks = again.clocks.empty() ? "" : ", and it reads " + again.clocks;
    return difference + " " + other.words + ": " + other.cause + clocks;
  }
  return "";
}

}  // namespace avoidbench
