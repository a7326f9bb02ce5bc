#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweep/sweep_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// The generators' names, as in `maps: {generator: forest}`.
const std::vector<std::string>& generator_names();

/// The axes found in the blocks, by their paths in a TrialSpec.
std::vector<Axis> axes_of_blocks(const Reading& reading);

/// Reads the block `axes`, {path: values}, into sweep.axes. Values are checked as the field itself
/// would be.
void read_axes(const YamlNode& node, SweepSpec& sweep, Reading& reading);

/// The axis of this path, or null.
Axis* axis_of(SweepSpec& sweep, const std::string& path);

/// Calls `check` with the sweep's TrialSpecs, planners and missions aside: with every combination
/// of the axes where there are up to 4096, else with each axis moved alone.
void for_each_combination(const SweepSpec& sweep,
                          const std::function<void(const TrialSpec&)>& check);

}  // namespace avoidbench
