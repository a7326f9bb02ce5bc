#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/trial_table.hpp"

namespace avoidbench {

/// Something of a trial that is not the same to the last bit.
struct Difference {
  TrialIdentity identity;
  std::string what;  ///< "outcome", a metric, "mission", or "trial" where one side has none
  std::string before, after;  ///< numbers with all digits; "" where there is none
};

struct ExactComparison {
  std::string base, now;  ///< files
  std::string base_sweep, new_sweep;
  std::vector<std::string> planners;  ///< labels of either side
  std::int64_t pair_count = 0;
  std::int64_t equal_count = 0;         ///< of the pairs: without any difference
  std::vector<std::string> metrics;     ///< that were compared
  std::vector<Difference> differences;  ///< by identity
  std::vector<std::string> warnings;
};

/// Compares outcomes, missions and every deterministic metric that both tables define, bit for bit;
/// NaN equals NaN. A trial that one side lacks is a difference. Throws InputError where a metric's
/// versions differ.
ExactComparison compare_exactly(const TrialTable& base, const TrialTable& now);

}  // namespace avoidbench
