#pragma once

#include <filesystem>

#include "sensing/sensor_spec.hpp"
#include "vehicle/vehicle_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// Reads the vehicle that `node` gives: a name or a mapping. A name is looked up as NAME.yaml in
/// vehicles/ and ../vehicles/ of the folder of the file that it stands in, then among the built-in
/// ones; with a slash or .yaml it is a file, relative to that folder. What the command line gives
/// is looked up from `base_folder`. A mapping changes fields of the vehicle that its key `preset`
/// names, of the hummingbird where there is none.
void read_vehicle(const YamlNode& node, const std::filesystem::path& base_folder,
                  VehicleSpec& vehicle, Reading& reading);

/// As read_vehicle, for sensors: folders sensors/, built-in depth_ideal.
void read_sensor(const YamlNode& node, const std::filesystem::path& base_folder, SensorSpec& sensor,
                 Reading& reading);

}  // namespace avoidbench
