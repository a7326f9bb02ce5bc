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
  /// Whether it compares flights, which means nothing where equal flights differ already.
  bool compares_flights = false;
};

/// All rules except loading and repeating, in the order in which they are tried. Those that compare
/// flights come after those that say whether it flies at all.
std::span<const ConformanceRule> conformance_rules();

}  // namespace avoidbench
