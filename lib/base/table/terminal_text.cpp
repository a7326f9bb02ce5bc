#include <algorithm>

#include "table/table_text.hpp"

namespace avoidbench {
namespace {

constexpr std::string_view kGap = "  ";

// Select Graphic Rendition (ECMA-48).
constexpr std::string_view kBold = "\033[1m", kDim = "\033[2m", kGreen = "\033[32m",
                           kYellow = "\033[33m", kPlain = "\033[0m";

std::string painted(const std::string& text, std::string_view colour, const TextStyle& style) {
  if (!style.is_coloured || text.find_first_not_of(' ') == std::string::npos) return text;
  return std::string(colour) + text + std::string(kPlain);
}

std::string aligned(const std::string& text, std::size_t width, bool is_left) {
  const std::string space(width - display_width(text), ' ');
  return is_left ? text + space : space + text;
}

std::string aligned(const std::string& text, const TextColumn& column) {
  return aligned(text, column.width, column.is_key || column.is_words);
}

/// Keys and as many columns from `first` on as fit; moves `first` behind them.
std::vector<std::size_t> next_block(const std::vector<TextColumn>& columns, std::size_t& first,
                                    std::size_t line_width) {
  std::vector<std::size_t> block;
  std::size_t width = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].is_key) continue;
    block.push_back(i);
    width += columns[i].width + kGap.size();
  }
  // The keys stand in each block, so that its rows can be read.
  const std::size_t key_count = block.size();
  for (; first < columns.size(); ++first) {
    if (columns[first].is_key) continue;
    const std::size_t more = columns[first].width + kGap.size();
    // One column at least, however narrow the terminal: else this would never end.
    if (block.size() > key_count && width + more > line_width + kGap.size()) break;
    block.push_back(first);
    width += more;
  }
  return block;
}

std::string trimmed(std::string line) {
  // Of a line of spaces only nothing stays: npos + 1 is 0.
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string as_it_is(const TextColumn&, const std::string& text) { return text; }

/// One line of a block, of a text from each column, painted by `paint(column, aligned text)`.
template <class TextOf, class Paint = decltype(&as_it_is)>
std::string block_line(const std::vector<TextColumn>& columns,
                       const std::vector<std::size_t>& block, TextOf text_of,
                       Paint paint = as_it_is) {
  std::string line;
  for (const std::size_t i : block) {
    line += (line.empty() ? "" : std::string(kGap)) +
            paint(columns[i], aligned(text_of(columns[i]), columns[i]));
  }
  return line;
}

/// Titles, headers, units and a rule.
std::string head_text(const Table& table, const std::vector<TextColumn>& columns,
                      const std::vector<std::size_t>& block, bool is_first,
                      const TextStyle& style) {
  // Colours are put on after widths were counted, since they have none.
  const auto line = [&](auto text_of, std::string_view colour) {
    return painted(trimmed(block_line(columns, block, text_of)), colour, style) + "\n";
  };
  std::string out = painted(table.title, kBold, style) + (is_first ? "" : " (continued)") + "\n";
  out += line([](const TextColumn& c) { return c.header; }, kBold);
  const bool has_units = std::any_of(block.begin(), block.end(),
                                     [&](std::size_t i) { return !columns[i].unit.empty(); });
  if (has_units) out += line([](const TextColumn& c) { return c.unit; }, kDim);
  std::string rule;
  for (const std::size_t i : block) {
    if (!rule.empty()) rule += kGap;
    for (std::size_t n = 0; n < columns[i].width; ++n) rule += "─";
  }
  return out + painted(rule, kDim, style) + "\n";
}

std::string row_text(const std::vector<TextColumn>& columns, const std::vector<std::size_t>& block,
                     std::size_t row, const TextStyle& style) {
  // A key that repeats is shown once, so that the eye sees the groups; the last key names the row
  // and stays.
  bool repeats = row > 0;
  auto keys_left =
      std::count_if(block.begin(), block.end(), [&](std::size_t i) { return columns[i].is_key; });
  const auto cell = [&](const TextColumn& c) -> std::string {
    if (!c.is_key) return c.cells[row];
    repeats = repeats && --keys_left > 0 && c.cells[row] == c.cells[row - 1];
    return repeats ? "" : c.cells[row];
  };
  const auto paint = [&](const TextColumn& c, const std::string& text) {
    return c.stars[row] != std::string::npos ? painted(text, kGreen, style) : text;
  };
  return trimmed(block_line(columns, block, cell, paint)) + "\n";
}

/// Header and rows, each on one line except for the last column, which is wrapped behind the
/// others.
std::string list_text(std::vector<TextColumn> columns, std::size_t row_count,
                      const TextStyle& style) {
  constexpr std::size_t kLeastWidth = 30;
  TextColumn last = std::move(columns.back());
  columns.pop_back();
  std::vector<std::size_t> others;
  std::size_t left = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    others.push_back(i);
    left += columns[i].width + kGap.size();
  }
  // The last column gets what is left of the line, and in a narrow terminal at least kLeastWidth.
  const std::size_t room = std::max(left + kLeastWidth, style.width) - left;
  const auto line = [&](const std::string& start, const std::string& end) {
    std::string text = wrapped(end, room, 0);
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
      text.insert(at + 1, std::string(left, ' '));
    }
    return trimmed(aligned(start, left, true) + text);
  };
  const std::string names =
      block_line(columns, others, [](const TextColumn& c) { return c.header; });
  std::string out = painted(line(names, last.header), kBold, style) + "\n";
  for (std::size_t row = 0; row < row_count; ++row) {
    const std::string cells =
        block_line(columns, others, [&](const TextColumn& c) { return c.cells[row]; });
    out += line(cells, last.is_words ? last.cells[row] : aligned(last.cells[row], last)) + "\n";
  }
  return out;
}

std::string table_text(const Table& table, const TextStyle& style) {
  const std::vector<TextColumn> columns = text_columns(table);
  // A list of the program's commands, not a table of results.
  if (table.title.empty()) return list_text(columns, table.rows.size(), style);
  std::string out;
  for (std::size_t first = 0; first < columns.size();) {
    const std::vector<std::size_t> block = next_block(columns, first, style.width);
    out += head_text(table, columns, block, out.empty(), style);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      out += row_text(columns, block, row, style);
    }
    out += "\n";
  }
  return out;
}

/// A line each; in a brief section one paragraph.
std::string legend_text(const Section& section, const TextStyle& style) {
  const auto lines = legend(section);
  std::string out;
  std::size_t header_width = 0;
  for (const auto& [header, doc] : lines) {
    header_width = std::max(header_width, display_width(header));
    out += (out.empty() ? "" : ", ") + header + " " + doc;
  }
  if (section.is_brief) return out.empty() ? out : wrapped(out, style.width, 0) + "\n";
  out.clear();
  for (const auto& [header, doc] : lines) {
    out +=
        wrapped(aligned(header, header_width, true) + "  " + doc, style.width, header_width + 2) +
        "\n";
  }
  return out;
}

}  // namespace

std::string terminal_text(const Section& section, const TextStyle& style) {
  std::string out;
  if (!section.title.empty()) {
    out = painted(wrapped(section.title, style.width, 2), kBold, style) + "\n\n";
  }
  const std::vector<std::string> warnings = shown_warnings(section);
  for (const std::string& warning : warnings) {
    out += painted(wrapped("Warning: " + warning, style.width, 9), kYellow, style) + "\n";
  }
  if (!warnings.empty()) out += "\n";
  for (const Table& table : section.tables) {
    if (table.is_for_people) out += table_text(table, style);
  }
  out += legend_text(section, style);
  if (!section.footer.empty()) out += wrapped(section.footer, style.width, 2) + "\n";
  return out;
}

}  // namespace avoidbench
