#pragma once

#include <filesystem>

namespace avoidbench {

/// The program itself: what is running, or what set_program_file() named.
/// "" where the system does not tell.
std::filesystem::path program_file();

/// For processes that are not the program but have its code, such as Python with its extension:
/// planners and data are then looked for as the program at `file` would. To be called before
/// anything else, while there is one thread; "": what is running.
void set_program_file(const std::filesystem::path& file);

/// The prefix that the program is installed to, or the build tree that it lies in: the nearest
/// folder above program_file() that has `share/avoidbench`. CMake finds the SDK in both.
/// "" if there is none.
std::filesystem::path installation_prefix();

/// Where the files lie that belong to the program: configs/, maps/, docs/, scripts/,
/// planners/template/, laid out as in the sources. Throws InputError if the program was copied
/// without them.
std::filesystem::path data_folder();

}  // namespace avoidbench
