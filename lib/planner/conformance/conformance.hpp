#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugin/call_times.hpp"
#include "plugin/planner_library.hpp"

namespace avoidbench {

/// One line of `avoidbench planners check`: what was tried, whether it held, and what was seen when
/// not.
struct ConformanceResult {
  std::string name;  ///< "reset_forgets"
  std::string doc;   ///< what the rule is and why
  bool passed = false;
  std::string finding;    ///< empty when passed
  bool was_tried = true;  ///< false where it means nothing: `finding` says why
};

/// Runs every rule of the planner interface on the library at `file`, by run_isolated: a crash or a
/// hang fails the rule that was being tried and ends the check there. Loading is the first rule; if
/// it fails, no other is tried. The rules before `repeats` have `time_limit_s` of wall time, and
/// those after it again.
std::vector<ConformanceResult> check_conformance_isolated(const std::filesystem::path& file,
                                                          double time_limit_s = 120.0);

/// What the library at `file`, or one beside it that it needs, imports of clocks, random numbers
/// and threads, which may make its answers differ from run to run: a line for people for each.
/// Read as data, never loaded.
std::vector<std::string> import_notes(const std::filesystem::path& file);

/// What calls of the library at `file` take, measured over some seconds at most of a flight toward
/// a wall with images of 160 × 120 pixels, by run_isolated. Nothing where it does not come to its
/// end.
std::optional<CallTimes> measure_calls_isolated(const std::filesystem::path& file,
                                                double time_limit_s = 60.0);

/// The plan period of that flight.
double measured_plan_period_s();

}  // namespace avoidbench
