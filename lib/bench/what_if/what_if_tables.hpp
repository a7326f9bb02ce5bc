#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "statistics/interval.hpp"
#include "table/table.hpp"
#include "what_if/what_if.hpp"

namespace avoidbench {

/// What a change does to the flights of one planner.
struct WhatIfCount {
  std::string planner_label;
  const Change* change = nullptr;
  std::int64_t failures = 0, cured = 0;    ///< flown; of them those that reach the goal now
  std::int64_t successes = 0, broken = 0;  ///< of the control; of them those that don't any more
  std::int64_t not_applicable = 0;         ///< failures that the change leaves as they are
  std::int64_t missing = 0;                ///< not flown yet
  std::int64_t maps = 0;                   ///< of the failures that were flown
  /// Of the cured share on maps like these: clustered_wilson_interval(); NaN for a single map.
  Interval cured_share;
};

/// By planner, then in the order of changes(); without planners of which nothing was chosen.
std::vector<WhatIfCount> count_what_ifs(const WhatIfPlan& plan);

/// "With true depth 13 of 16 of ego's failures vanish (81 %, 57–93); of 16 successes 1 breaks."
std::string sentence_of(const WhatIfCount& count);

/// Tables `what_if` and `what_if_sentences` of many trials; of one (WhatIfRequest::trial) the table
/// `what_if_trial`. `database`: what the section is called.
Section what_if_section(const WhatIfPlan& plan, const WhatIfRequest& request,
                        const std::string& database);

/// Flights with nothing changed that are not the stored ones: a line each.
std::vector<std::string> what_if_differences(const WhatIfPlan& plan);

}  // namespace avoidbench
