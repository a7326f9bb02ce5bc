#pragma once

#include <CLI/CLI.hpp>

namespace avoidbench {

/// Adds `list` to the command `maps`.
void add_maps_list_command(CLI::App& maps);

}  // namespace avoidbench
