#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "conformance/conformance_flight.hpp"
#include "plugin/planner_library.hpp"

namespace avoidbench {

/// Wall time that a flight in a process of its own may take.
inline constexpr double kFlightLimit_s = 60.0;

/// Whether each trial of the planner is flown by a new process: AB_USES_GLOBALS.
bool needs_own_process(const PlannerLibrary& library);

/// What `work` gives. Where the planner needs a process of its own it runs in a fork of this one,
/// which has made no instance yet, so that each flight finds globals as they were loaded.
std::string in_own_process(const PlannerLibrary& library, const std::function<std::string()>& work);

/// The same for the answers of a flight; none where the process did not come to its end.
std::vector<Reply> replies_in_own_process(const PlannerLibrary& library,
                                          const std::function<std::vector<Reply>()>& work);

/// Replies without their times, for another process of this program.
std::string bytes_of(const std::vector<Reply>& replies);
std::vector<Reply> replies_of(std::string_view bytes);

}  // namespace avoidbench
