#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace avoidbench {

/// When a planner has flown enough: its success rate's 95 % Wilson interval is narrow. Looked at
/// after fixed numbers of missions per map, so that the trials flown depend on nothing but results.
struct StopRule {
  double half_width = 0.0;  ///< of the interval, less than which is enough; 0: no rule

  bool is_set() const { return half_width > 0.0; }
  std::string text() const;  ///< as parse_stop_rule() reads it; "" without rule
};

/// Reads `success_rate ci<0.05`: ± 0.05. Throws InputError for anything else.
StopRule parse_stop_rule(const std::string& text);

/// Whether these trials of a planner are enough.
bool is_enough(const StopRule& rule, std::int64_t finished_count, std::int64_t trial_count);

/// After how many missions per map the rule is looked at: each tenth of them, the last number is
/// `mission_count`.
std::vector<std::int64_t> looks(std::int64_t mission_count);

}  // namespace avoidbench
