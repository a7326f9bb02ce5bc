#pragma once

#include "sweep/sweep_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// Makes the paths of the files of maps, wind fields and replayed latencies absolute, in the
/// sweep's base and axes: relative to the file that they stand in, those of the command line to the
/// working folder. Fills in the base's digests where the file is no axis. Adds a problem for a file
/// that is not there, for one that has another digest than was asked for, for a wind field that is
/// none, and for several seeds of a map from a file, which has no use for them.
void resolve_files(SweepSpec& sweep, Reading& reading);

}  // namespace avoidbench
