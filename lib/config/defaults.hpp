#pragma once

#include <string>

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

}  // namespace avoidbench
