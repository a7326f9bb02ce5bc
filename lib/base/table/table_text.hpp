#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "table/table.hpp"

namespace avoidbench {

/// Terminal columns that UTF-8 text takes: 2 for East Asian wide characters and emoji, 0 for
/// combining ones.
std::size_t display_width(std::string_view utf8);

/// `utf8`, cut to `width` terminal columns with … at its end where it is wider.
std::string cut_to_width(std::string_view utf8, std::size_t width);

/// Each text cut to `width` columns so that no two that differ look the same: such are cut in their
/// middle, and if that is not enough not at all.
std::vector<std::string> cut_apart(const std::vector<std::string>& texts, std::size_t width);

/// `text` in lines of at most `width` columns, broken at spaces, all but the first indented by
/// `indent`.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent);

/// Decimals that show `digits` digits of a number of this size, at most 6.
int decimals_for(double size, int digits);

/// What stands above a column: its header, or its name where it has none.
std::string shown_header(const Column& column);

/// One column as people read it: numbers of one column have the same number of decimals, intervals
/// are beside them.
struct TextColumn {
  std::string header, unit, doc;
  bool is_key = false;
  bool is_words = false;  ///< as Place::words
  std::vector<std::string> cells;
  /// Of each cell, where the star stands that marks it as best; npos: it is not the best. Texts may
  /// have stars of their own.
  std::vector<std::size_t> stars;
  std::size_t width = 0;  ///< terminal columns of the widest of all these
};

/// The columns that people read. Numbers get three significant digits of the column's greatest.
std::vector<TextColumn> text_columns(const Table& table);

// The formats that people read, of one section each; format_sections() is what others call.

std::string terminal_text(const Section& section, const TextStyle& style);
std::string markdown_text(const Section& section);
std::string latex_text(const Section& section);

/// Every column's doc once (in a brief section Column::brief), then the section's notes:
/// ("PO", "path optimality …").
std::vector<std::pair<std::string, std::string>> legend(const Section& section);

/// JSON as text with a newline at its end.
std::string dumped(const nlohmann::ordered_json& json);

/// The section's warnings; of a brief one with several one line of them all, without details.
std::vector<std::string> shown_warnings(const Section& section);

}  // namespace avoidbench
