#pragma once

#include <ostream>

namespace avoidbench {

/// From now on, what is written to std::cout and std::cerr is shown and not obeyed by the terminal
/// (base/visible_text.hpp), whoever made it: labels, reasons, names of files, of databases of
/// somebody else's too. Only this program's own colours pass.
void make_streams_visible();

/// Standard output for data that programs read, CSV, JSON and YAML: untouched, except on a
/// terminal, where it is shown as messages are.
std::ostream& data_output();

}  // namespace avoidbench
