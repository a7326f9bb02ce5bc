#pragma once

#include "sweep/sweep_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// For maps that come from files: makes the paths in the sweep's base and axes absolute (relative
/// to the file that they stand in, those of the command line to the working folder) and fills the
/// base's file_digest, where the file is no axis. Adds a problem for a file that is not there or
/// has another digest than was asked for, and for several seeds, which such a map has no use for.
void resolve_map_files(const YamlNode& root, SweepSpec& sweep, Reading& reading);

/// The same for the file of a wind field, which is read once to see that it is one; an axis may
/// have "" among its values for no field.
void resolve_wind_file(const YamlNode& root, SweepSpec& sweep, Reading& reading);

/// Makes the path of the database of replayed latencies absolute, and adds a problem where it is
/// not there.
void resolve_latency_file(const YamlNode& root, SweepSpec& sweep, Reading& reading);

}  // namespace avoidbench
