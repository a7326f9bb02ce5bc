#pragma once

#include <string>
#include <vector>

#include "yaml/yaml_tree.hpp"

namespace avoidbench {

/// Applies `--set path=value` options to a document, in order. A path is dotted,
/// `planners[0].label` counts into lists; keys that are not there are added; the value is YAML. A
/// name that stands for a whole block, as in `vehicle: firefly`, becomes that block's preset when a
/// key below it is set. Throws InputError with all the problems.
void apply_overrides(YamlNode& root, const std::vector<std::string>& overrides);

}  // namespace avoidbench
