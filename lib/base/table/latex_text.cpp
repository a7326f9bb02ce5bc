#include <functional>

#include "base/words.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

/// What LaTeX reads otherwise, and the signs of our headers that pdfLaTeX's fonts lack.
/// Longer ones stand before their beginnings (P_τ before _, ^2 before ^).
constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
    {"P_τ", R"($P_\tau$)"},
    {"\\", R"(\textbackslash{})"},
    {"_", R"(\_)"},
    {"%", R"(\%)"},
    {"&", R"(\&)"},
    {"#", R"(\#)"},
    {"$", R"(\$)"},
    {"{", R"(\{)"},
    {"}", R"(\})"},
    {"~", R"(\textasciitilde{})"},
    {"^2", R"($^2$)"},
    {"^3", R"($^3$)"},
    {"^", R"(\textasciicircum{})"},
    {"<", R"($<$)"},
    {">", R"($>$)"},
    {"–", "--"},
    {"…", R"(\ldots{})"},
    {"’", "'"},
    {"τ", R"($\tau$)"},
    {"ρ", R"($\rho$)"},
    {"∫", R"($\int$)"},
    {"‖", R"($\|$)"},
    {"·", R"($\cdot$)"},
    {"²", R"($^2$)"},
    {"³", R"($^3$)"},
    {"°", R"($^\circ$)"},
    {"µ", R"($\mu$)"},
};

std::string in_latex(std::string_view text) { return replaced(text, kSigns); }

/// A cell; what is marked as best, by a star at this place, is bold instead.
std::string cell_in_latex(const std::string& cell, std::size_t star) {
  if (star == std::string::npos) return in_latex(cell);
  return R"(\textbf{)" + in_latex(cell.substr(0, star)) + "}" + in_latex(cell.substr(star + 1));
}

/// Labels of LaTeX take letters, digits and hyphens safely.
std::string label_of(const std::string& sweep, const std::string& table) {
  std::string label = "tab:";
  for (const char c : sweep + "-" + table) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    label += is_plain ? c : '-';
  }
  return label;
}

std::string line_of(const std::vector<TextColumn>& columns,
                    const std::function<std::string(const TextColumn&)>& text_of) {
  std::string line = "  ";
  for (std::size_t i = 0; i < columns.size(); ++i)
    line += (i > 0 ? " & " : "") + text_of(columns[i]);
  return line + " \\\\\n";
}

/// A column's doc without the name for machines that it begins with.
std::string bare_doc(const TextColumn& column) {
  // "success_rate: finished of all …": one word with an underscore before the colon.
  const std::size_t colon = column.doc.find(": ");
  const bool has_name =
      colon != std::string::npos && column.doc.find(' ') > colon && column.doc.find('_') < colon;
  return has_name ? column.doc.substr(colon + 2) : column.doc;
}

/// In booktabs' style; what columns mean stands above it in comments.
std::string table_in_latex(const std::string& sweep, const Table& table) {
  const std::vector<TextColumn> columns = text_columns(table);
  std::string caption = table.title.empty() ? "" : in_latex(table.title) + ".";
  std::string out, alignment;  // what the columns mean stands in comments: captions stay short
  bool has_units = false, has_best = false;
  for (const TextColumn& column : columns) {
    alignment += column.is_key || column.is_words ? 'l' : 'r';
    has_units = has_units || !column.unit.empty();
    if (!column.doc.empty()) out += "% " + column.header + ": " + bare_doc(column) + "\n";
    for (const std::size_t star : column.stars) has_best = has_best || star != std::string::npos;
  }
  if (has_best) caption += " Bold: significantly best.";
  out += "\\begin{table}\n  \\centering\n";
  if (!caption.empty()) {
    out += "  \\caption{" + caption + "}\n  \\label{" + label_of(sweep, table.name) + "}\n";
  }
  out += "  \\begin{tabular}{" + alignment + "}\n  \\toprule\n";
  out += line_of(columns, [](const TextColumn& c) { return in_latex(c.header); });
  if (has_units) out += line_of(columns, [](const TextColumn& c) { return in_latex(c.unit); });
  out += "  \\midrule\n";
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    // As in a terminal: the first of several keys is shown once a group.
    bool repeats = row > 0;
    out += line_of(columns, [&](const TextColumn& c) -> std::string {
      const bool is_group =
          c.is_key && &c == &columns.front() && columns.size() > 1 && columns[1].is_key;
      repeats = repeats && is_group && c.cells[row] == c.cells[row - 1];
      if (repeats) return "";
      return cell_in_latex(c.cells[row], c.stars[row]);
    });
  }
  return out + "  \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
}

}  // namespace

std::string latex_text(const Section& section) {
  std::string out = section.title.empty() ? "" : "% " + section.title + "\n";
  for (const std::string& warning : shown_warnings(section)) out += "% Warning: " + warning + "\n";
  for (const Table& table : section.tables) {
    if (!table.is_for_people) continue;
    out += (out.empty() ? "" : "\n") + table_in_latex(section.name, table);
  }
  return out;
}

}  // namespace avoidbench
