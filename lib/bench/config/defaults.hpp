#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace avoidbench {

/// What can be printed: "sweep", and the vehicles and sensors that are built in.
std::vector<std::string> default_names();

/// A file with every key at its default, or as the vehicle or sensor of this name has it, each with
/// its doc and range as a comment. It reads back to the same bits. Throws InputError for other
/// names.
std::string defaults_yaml(const std::string& name);

/// JSON on one line as YAML in people's style: {generator: hall, area_m: [20, 30]}.
std::string flow_yaml(const nlohmann::ordered_json& json);

/// The keys of a sweep as its file, in people's style: blocks, lists of numbers on one line, keys
/// in the order of the documentation. It reads back to the same bits.
std::string sweep_file_yaml(const nlohmann::json& keys);

}  // namespace avoidbench
