#pragma once

#include <span>
#include <string>
#include <string_view>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// A rule of the planner interface that can be tried on a loaded library.
struct ConformanceRule {
  std::string_view name;
  std::string_view doc;
  /// What was seen against the rule; empty when it held.
  std::string (*finding)(const PlannerLibrary& library);
};

/// All rules but loading, in the order in which they are tried.
std::span<const ConformanceRule> conformance_rules();

}  // namespace avoidbench
