#pragma once

#include <ostream>
#include <string_view>

namespace avoidbench {

/// From now on, what is written to std::cout and std::cerr is shown and not obeyed by the terminal
/// (base/visible_text.hpp), whoever made it: labels, reasons, names of files, of databases of
/// somebody else's too. Only this program's own colours pass. Standard error holds nothing up: what
/// a stopped terminal or a full pipe does not take within ten seconds is dropped.
void make_streams_visible();

/// Standard output for data that programs read, CSV, JSON and YAML: untouched, except on a
/// terminal, where it is shown as messages are.
std::ostream& data_output();

/// Writes to standard error, as it is, what that takes without waiting; the rest is dropped.
void show_at_once(std::string_view text);

}  // namespace avoidbench
