#pragma once

#include <string>

#include "explain/causes.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// Why a flight failed, in sentences with its numbers; each ends with a full stop. `outcome` and
/// `reason` are the flight's.
std::string paragraph(const CauseFound& explanation, Outcome outcome, const std::string& reason);

/// The moment that shows it best: the last chance, where it came nearest to the goal, or the end.
double decisive_s(const CauseFound& explanation, double end_time_s);

/// "occluded: something stood before it until too late".
std::string cause_text(Cause cause);

}  // namespace avoidbench
