#pragma once

#include <string>
#include <vector>

#include "trial/trial_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// Reads the list of planners: bare names, or mappings {plugin, label, parameters, camera,
/// max_speed_mps}.
/// Each library is found, relative paths from the folder of the file that they stand in, and
/// loaded, and its parameters are checked and filled in. A list of values for a parameter gives one
/// planner for each, with the value in its label: `ego[horizon_m=5]`. Labels are unique.
/// `max_speed`, where given, is the sweep's own max_speed_mps: that of each planner that is given
/// no other, or an error where it declares no such parameter. `sensors` are all that the sweep
/// flies with: a planner that can't fly with one of them is an error, and so is one that declares
/// no AB_INPUT_GOALS where the missions ask for it by `goals`, see goals_demand().
std::vector<PlannerChoice> read_planners(const GivenValue& given, const YamlNode* max_speed,
                                         const std::vector<SensorSpec>& sensors,
                                         const std::string& goals);

}  // namespace avoidbench
