#pragma once

#include <functional>
#include <optional>

#include "conformance/conformance.hpp"

namespace avoidbench {

/// Runs the rules on `file` in this process: a planner that crashes ends it. `begin` hears each
/// rule before it is tried, `end` after.
void run_conformance(const std::filesystem::path& file,
                     const std::function<void(const ConformanceResult&)>& begin,
                     const std::function<void(const ConformanceResult&)>& end);

}  // namespace avoidbench
