#pragma once

#include "sweep/sweep_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// Reads mission.list or mission.file of a sweep's document into sweep.missions, if there is one.
void read_missions(const YamlNode& root, SweepSpec& sweep, Reading& reading);

/// Without `trials` in the document, sets sweep.trials to all missions that are listed. Adds a
/// problem for each mission of a map that the sweep has not, for maps without a mission and for
/// more trials than missions.
void settle_missions(const YamlNode& root, SweepSpec& sweep, Reading& reading);

}  // namespace avoidbench
