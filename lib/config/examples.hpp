#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/field_tree.hpp"

namespace avoidbench {

/// JSON on one line as YAML in people's style: {generator: hall, area_m: [20, 30]}.
std::string flow_yaml(const nlohmann::ordered_json& json);

/// `maps: {generator: hall, height_m: 5}` for maps.height_m, the kinds said first.
std::string example_line(const std::string& path, const std::vector<SaidKind>& kinds,
                         const nlohmann::ordered_json& value);

/// One or two values for a field of the sweep: its preset, and another that contradicts nothing
/// else's preset; none where there is no example.
std::vector<nlohmann::json> example_values(const FieldTree& sweep, const std::string& path,
                                           const KindField& field);

/// The same for a field that stands alone, as a planner's parameter.
std::vector<nlohmann::json> example_values(const FieldTree& field);

}  // namespace avoidbench
