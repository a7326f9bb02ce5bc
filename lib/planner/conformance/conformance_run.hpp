#pragma once

#include <functional>

#include "conformance/conformance.hpp"

namespace avoidbench {

/// Hears of a rule before it is tried, or after.
using OnRule = std::function<void(const ConformanceResult&)>;

/// Runs all rules on `file` in this process: a planner that crashes ends it.
void run_conformance(const std::filesystem::path& file, const OnRule& begin, const OnRule& end);

/// Loading, and the rules before the first that compares flights. Whether it loads.
bool run_first_rules(const std::filesystem::path& file, const OnRule& begin, const OnRule& end);

/// Whether equal flights give equal answers, tried in forks of this process alone.
ConformanceResult run_repeats_rule(const std::filesystem::path& file);

/// The rules from the first that compares flights on; those that do are not tried unless the
/// planner `repeats`.
void run_other_rules(const std::filesystem::path& file, bool repeats, const OnRule& begin,
                     const OnRule& end);

}  // namespace avoidbench
