#pragma once

#include <filesystem>
#include <vector>

#include "config/yaml_reader.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// Reads the list of planners: bare names, or mappings {plugin, label, parameters, max_speed_mps}.
/// Each library is found, relative paths from `base_folder`, and loaded, and its parameters are
/// checked and filled in. A list of values for a parameter gives one planner for each, with the
/// value in its label: `ego[horizon_m=5]`. Labels are unique.
std::vector<PlannerChoice> read_planners(const YamlNode& node,
                                         const std::filesystem::path& base_folder,
                                         Reading& reading);

}  // namespace avoidbench
