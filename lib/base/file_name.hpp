#pragma once

#include <string>
#include <string_view>

namespace avoidbench {

/// A file's name made of a text that a database or a sweep gives: the text itself where it is a
/// plain name of A-Z a-z 0-9 _ . -, at most 100 letters long, that begins with neither . nor -.
/// Else other letters become _, and the text's digest follows, so that two texts do not share a
/// file. Never a path, hidden, or an option. scripts/plot/paper_figures.py does the same.
std::string safe_file_name(std::string_view text);

}  // namespace avoidbench
