#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "store/rows.hpp"

namespace avoidbench {

/// How many of a planner's failures have this cause.
struct CauseCount {
  std::size_t planner = 0;                    ///< index into the planners
  std::string cause;                          ///< "": not told yet
  std::int64_t count = 0, failure_count = 0;  ///< of it; of all its failures
};

/// By planner, the most frequent first, those not told last. Empty where no cause is told.
std::vector<CauseCount> cause_counts(std::span<const TrialSummary> trials,
                                     std::span<const PlannerRow> planners);

}  // namespace avoidbench
