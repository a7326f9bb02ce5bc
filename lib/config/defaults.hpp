#pragma once

#include <string>

#include "config/field_tree.hpp"
#include "sensing/sensor_spec.hpp"
#include "vehicle/vehicle_spec.hpp"

namespace avoidbench {

/// A sweep file with every key at its default, each with its doc and range as a comment. It reads
/// back as it is.
std::string sweep_defaults_yaml();

/// The vehicle as a file for configs/vehicles, commented; it reads back to the same bits.
std::string vehicle_yaml(const VehicleSpec& vehicle);

/// The sensor as a file for configs/sensors, commented; it reads back to the same bits.
std::string sensor_yaml(const SensorSpec& sensor);

/// JSON on one line as YAML in people's style: {generator: hall, area_m: [20, 30]}.
std::string flow_yaml(const nlohmann::ordered_json& json);

}  // namespace avoidbench
