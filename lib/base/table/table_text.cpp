#include "table/table_text.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "base/number_text.hpp"
#include "base/utf8.hpp"

namespace avoidbench {
namespace {

struct CodeRange {
  char32_t first, last;
};

/// East Asian width and combining marks, as whole blocks of Unicode: few enough for a table by
/// hand, right for what labels and headers have.
constexpr CodeRange kCombining[] = {
    {0x300, 0x36f}, {0x200b, 0x200f}, {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}};
constexpr CodeRange kWide[] = {{0x1100, 0x115f}, {0x2e80, 0xa4cf},   {0xac00, 0xd7a3},
                               {0xf900, 0xfaff}, {0xfe30, 0xfe6f},   {0xff00, 0xff60},
                               {0xffe0, 0xffe6}, {0x1f300, 0x1faff}, {0x20000, 0x3fffd}};

bool is_in(char32_t code, std::span<const CodeRange> ranges) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const CodeRange& range) {
    return code >= range.first && code <= range.last;
  });
}

/// The character at `at`, which moves on behind it. A byte that begins none stands for itself.
char32_t next_character(std::string_view utf8, std::size_t& at) {
  const Utf8Character character = first_character(utf8.substr(at));
  at += std::max<std::size_t>(character.length, 1);
  return character.code;
}

std::size_t width_of(char32_t code) {
  if (is_in(code, kCombining)) return 0;
  return is_in(code, kWide) ? 2 : 1;
}

std::string with_decimals(double value, int decimals) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value < 0.0 ? "-inf" : "inf";
  double least = 1.0;  // that is not shown as zero
  for (int i = 0; i < decimals; ++i) least *= 0.1;
  // "<0.01" and not "0.00": a small p or ratio is not zero.
  if (value > 0.0 && value < 0.5 * least) return "<" + with_decimals(least, decimals);
  return fixed_digits(value, decimals);
}

/// Decimals that show three significant digits of the greatest of the column's numbers.
int decimals_of(const Table& table, std::size_t column) {
  if (table.columns[column].decimals >= 0) return table.columns[column].decimals;
  double greatest = 0.0;
  for (const std::vector<Cell>& row : table.rows) {
    const double* value = std::get_if<double>(&row[column].value);
    if (value != nullptr && std::isfinite(*value)) greatest = std::max(greatest, std::abs(*value));
  }
  // Ratios look alike with two decimals, whether their greatest is 1 or 0.3.
  return greatest <= 1.0 && greatest > 0.1 ? 2 : decimals_for(greatest, 3);
}

std::string cell_text(const Cell& cell, int decimals) {
  if (const auto* value = std::get_if<double>(&cell.value)) return with_decimals(*value, decimals);
  const bool is_defined = !std::holds_alternative<std::monostate>(cell.value);
  return is_defined ? text_of(cell.value) : "–";
}

}  // namespace

int decimals_for(double size, int digits) {
  // One decimal less for each power of ten of the number, one more for each below 1.
  int decimals = digits - 1;
  // Ten times smaller is one decimal more; six at most, since 0 would take endlessly many.
  for (double limit = 10.0; size >= limit && decimals > 0; limit *= 10.0) --decimals;
  for (double limit = 1.0; size < limit && size > 0.0 && decimals < 6; limit *= 0.1) ++decimals;
  return decimals;
}

std::size_t display_width(std::string_view utf8) {
  std::size_t width = 0;
  for (std::size_t at = 0; at < utf8.size();) width += width_of(next_character(utf8, at));
  return width;
}

std::string cut_to_width(std::string_view utf8, std::size_t width) {
  if (display_width(utf8) <= width) return std::string(utf8);
  std::size_t used = 0, at = 0;
  while (at < utf8.size()) {
    std::size_t next = at;
    const std::size_t more = width_of(next_character(utf8, next));
    // One more for the ellipsis.
    if (used + more + 1 > width) break;
    used += more;
    at = next;
  }
  return std::string(utf8.substr(0, at)) + "…";
}

std::vector<std::string> cut_apart(const std::vector<std::string>& texts, std::size_t width) {
  const auto in_middle = [&](const std::string& text) {
    if (display_width(text) <= width) return text;
    const std::string head = cut_to_width(text, width - width / 2);
    // The ellipsis at the head's end is none of the text's.
    std::size_t at = head.size() - std::string_view("…").size();
    while (at < text.size() && display_width(std::string_view(text).substr(at)) > width / 2) {
      next_character(text, at);
    }
    return head + text.substr(at);
  };
  using Cut = std::function<std::string(const std::string&)>;
  // From the shortest way to the whole text: texts that begin alike are shown with beginning and
  // end, and in full if those are alike too.
  const Cut cuts[] = {[&](const std::string& text) { return cut_to_width(text, width); }, in_middle,
                      [](const std::string& text) { return text; }};
  std::vector<std::string> shown(texts.size());
  std::vector<bool> is_clear(texts.size(), false);
  for (const Cut& cut : cuts) {
    std::map<std::string, std::set<std::string>> texts_of;  // by what is shown of them
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (!is_clear[i]) shown[i] = cut(texts[i]);
      texts_of[shown[i]].insert(texts[i]);
    }
    // What stands for one text only keeps its cut; the others try the next one.
    for (std::size_t i = 0; i < texts.size(); ++i) is_clear[i] = texts_of[shown[i]].size() == 1;
  }
  return shown;
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string lines;
  std::size_t used = 0;
  while (!text.empty()) {
    // Lines break at spaces only; a word longer than a line stands out of it.
    const std::size_t space = text.find(' ', text.find_first_not_of(' '));
    const std::string_view word = text.substr(0, space);  // with the spaces before it
    text.remove_prefix(word.size());
    if (used > 0 && used + display_width(word) > width) {
      lines += "\n" + std::string(indent, ' ');
      const std::string_view bare = word.substr(std::min(word.size(), word.find_first_not_of(' ')));
      lines += bare;
      used = indent + display_width(bare);
    } else {
      lines += word;
      used += display_width(word);
    }
  }
  return lines;
}

std::string shown_header(const Column& column) {
  return column.header.empty() ? column.name : column.header;
}

std::vector<TextColumn> text_columns(const Table& table) {
  constexpr std::size_t kMostColumns = 44;  // of a text: two of them and a number fit on a line
  std::vector<TextColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    if (column.place == Place::machine || column.place == Place::bound) continue;
    TextColumn text{.header = shown_header(column),
                    .unit = column.unit,
                    .doc = column.doc,
                    .is_key = column.place == Place::key,
                    .is_words = column.place == Place::words,
                    .cells = {},
                    .stars = {}};
    text.width = std::max(display_width(text.header), display_width(text.unit));
    // make_table() puts the two bounds behind their value.
    const bool has_interval =
        i + 2 < table.columns.size() && table.columns[i + 1].place == Place::bound;
    int decimals = decimals_of(table, i);
    // A value with its bounds takes three numbers' room.
    if (has_interval) decimals = std::min(decimals, 2);
    const bool has_star = std::any_of(table.rows.begin(), table.rows.end(),
                                      [&](const auto& row) { return row[i].is_best; });
    std::vector<std::string> cells;
    for (const auto& row : table.rows) cells.push_back(cell_text(row[i], decimals));
    if (column.place != Place::words) cells = cut_apart(cells, kMostColumns);
    for (std::size_t at = 0; at < table.rows.size(); ++at) {
      const Row& row = table.rows[at];
      std::string cell = std::move(cells[at]);
      // The star belongs to the number, so it stands right behind it; the others keep its place
      // free.
      text.stars.push_back(row[i].is_best ? cell.size() : std::string::npos);
      if (has_star) cell += row[i].is_best ? "*" : " ";
      if (has_interval && std::holds_alternative<double>(row[i].value)) {
        const std::string lower = cell_text(row[i + 1], decimals);
        const std::string upper = cell_text(row[i + 2], decimals);
        // Without either end there is no interval; one alone may be unknown.
        const bool has_end = lower != "–" || upper != "–";
        cell += has_end ? " [" + lower + ", " + upper + "]" : "";
      }
      text.width = std::max(text.width, display_width(cell));
      text.cells.push_back(std::move(cell));
    }
    columns.push_back(std::move(text));
  }
  return columns;
}

}  // namespace avoidbench
