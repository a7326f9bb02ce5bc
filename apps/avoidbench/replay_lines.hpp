#pragma once

#include <string>
#include <vector>

#include "export/export_flight.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

// What `replay` says of a flight, a line each.

std::string outcome_line(const TrialRecord& record);
std::string calls_line(const std::vector<CommandLine>& calls);
/// "(1.00, -2.50, 2.00) m, 1.20 m/s, 0.35 m from the nearest surface, at 3.200 s"
std::string place_line(const Sample& sample);

}  // namespace avoidbench
