#pragma once

#include <filesystem>

namespace avoidbench {

/// The prefix that the program is installed to, or the build tree that it lies in: the nearest
/// folder above the running program that has `share/avoidbench`. CMake finds the SDK in both.
/// "" if there is none.
std::filesystem::path installation_prefix();

/// Where the files lie that belong to the program: configs/, maps/, docs/, scripts/,
/// planners/template/, laid out as in the sources. Throws InputError if the program was copied
/// without them.
std::filesystem::path data_folder();

}  // namespace avoidbench
