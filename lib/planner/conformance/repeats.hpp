#pragma once

#include "conformance/conformance.hpp"

namespace avoidbench {

/// The rule `repeats` before it is tried: its name and what it is.
ConformanceResult repeats_rule();

/// Flies the planner at `file` several times toward the wall, each time by a new process that loads
/// it under other circumstances: why its answers differ, or "". Call it where no library is loaded
/// that has started threads: new processes are forks.
std::string repeats_finding(const std::filesystem::path& file);

}  // namespace avoidbench
