#pragma once

#include <string>
#include <string_view>

namespace avoidbench {

/// UTF-8 that a terminal shows and does not obey: control characters (C0, C1, delete), marks that
/// turn the direction of writing, separators of lines, and bytes that are no UTF-8 are replaced by
/// escapes to look at, \x1b and \u202e. New lines, tabs and CR LF stay. All messages go through it
/// (show_control_characters() of the program); text without such characters is returned as it is.
std::string visible_text(std::string_view text);

/// The same for what has to stay on one line, a label, a reason, a cell: new lines and tabs become
/// \n, \r and \t.
std::string visible_line(std::string_view text);

/// The bytes at the end of `text` that begin a UTF-8 character or a CR LF and do not end it: 0
/// to 3.
std::size_t unfinished_bytes(std::string_view text);

}  // namespace avoidbench
