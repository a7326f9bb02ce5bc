#pragma once

#include <string>
#include <vector>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// One line of `avoidbench planners check`: what was tried, whether it held, and what was seen when not.
struct ConformanceResult {
  std::string name;      ///< "reset_twice_gives_equal_commands"
  std::string doc;       ///< what the rule is and why
  bool passed = false;
  std::string finding;   ///< empty when passed
};

/// Runs every rule of the planner interface on the library at `file`, in this process (a planner that crashes ends it: the command
/// runs this in a child process). Loading is the first rule.
std::vector<ConformanceResult> check_conformance(const std::filesystem::path& file);

}  // namespace avoidbench
