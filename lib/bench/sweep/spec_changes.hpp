#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace avoidbench {

/// Where two stored sweeps (SweepRow::spec_json) of one name differ, a short text each: "trials 5 →
/// 10", "map.poisson_radius_m 2.5 → [2.5,3.0]", "planner mine: another file".
std::vector<std::string> spec_changes(std::string_view former_json, std::string_view json);

}  // namespace avoidbench
