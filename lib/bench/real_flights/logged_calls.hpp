#pragma once

#include <string>
#include <vector>

#include "trial/trial_record.hpp"

namespace avoidbench {

/// The planner's calls in a CSV file: the columns time_s (after the log's first pose), cpu_time_s
/// and wall_time_s, as `avoidbench export calls` writes them; others are passed over, and empty
/// fields are not known. Times are moved by -begin_s. Throws InputError with the line.
std::vector<PlanCall> read_logged_calls(const std::string& file, double begin_s);

}  // namespace avoidbench
