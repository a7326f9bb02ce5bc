#pragma once

#include <CLI/CLI.hpp>

namespace avoidbench {

/// Adds `find` to the command `maps`.
void add_maps_find_command(CLI::App& maps);

}  // namespace avoidbench
