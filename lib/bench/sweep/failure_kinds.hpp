#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "store/rows.hpp"

namespace avoidbench {

/// The trials that did not reach the goal and ended in the same way, and why most of them did.
struct FailureKind {
  Outcome outcome = Outcome::timed_out;
  std::int64_t count = 0;
  std::vector<std::pair<std::string, std::int64_t>> planners;  ///< label, trials; most trials first
  std::int64_t alike_count = 0;  ///< trials of the most frequent reason
  TrialListing example;          ///< the first of them
};

/// The kinds of failure among `trials`, the most frequent first. Reasons that differ in their
/// numbers only (obstacle, place, speed) are one reason.
std::vector<FailureKind> failure_kinds(std::span<const TrialListing> trials);

/// What a run says of it, one line without the command that shows the example: "6 collided (ego 5,
/// mine 1), 4 of them as trial 12: touched trunk 3 at …".
std::string failure_text(const FailureKind& kind);

}  // namespace avoidbench
