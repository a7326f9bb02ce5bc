#include <algorithm>

#include "base/words.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

std::string in_markdown(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    // "](" would make a link of what a planner is called.
    const bool ends_link_text = c == '(' && escaped.ends_with(']');
    const bool is_mark = c == '|' || c == '*' || c == '_' || c == '<' || c == '`' || c == '\\';
    if (is_mark || ends_link_text) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace

std::string markdown_text(const Section& section) {
  std::string out = section.title.empty() ? "" : "## " + in_markdown(section.title) + "\n\n";
  const std::vector<std::string> warnings = shown_warnings(section);
  // One block quote, with an empty line of it between the warnings and none at its end.
  for (const std::string& warning : warnings)
    out += "> **Warning:** " + in_markdown(warning) + "\n>\n";
  if (!warnings.empty()) out.replace(out.size() - 2, 2, "\n");
  for (const Table& table : section.tables) {
    if (!table.is_for_people) continue;
    if (!table.title.empty()) out += "### " + in_markdown(table.title) + "\n\n";
    out += "|";
    const std::vector<TextColumn> columns = text_columns(table);
    for (const TextColumn& column : columns) {
      out +=
          " " + in_markdown(column.header + (column.unit.empty() ? "" : ", " + column.unit)) + " |";
    }
    out += "\n|";
    for (const TextColumn& column : columns)
      out += column.is_key || column.is_words ? ":--|" : "--:|";
    out += "\n";
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      out += "|";
      for (const TextColumn& column : columns) out += " " + in_markdown(column.cells[row]) + " |";
      out += "\n";
    }
    // An empty line between tables; a list ends where its rows end.
    if (!table.title.empty()) out += "\n";
  }
  std::vector<std::string> lines;
  for (const auto& [header, doc] : legend(section)) {
    lines.push_back((section.is_brief ? "**" : "- **") + in_markdown(header) + "** " +
                    in_markdown(doc));
  }
  if (!lines.empty()) out += joined(lines, section.is_brief ? ", " : "\n") + "\n";
  if (!section.footer.empty()) out += "\n" + in_markdown(section.footer) + "\n";
  return out;
}

std::vector<std::string> shown_warnings(const Section& section) {
  // In brief, several warnings become one line: each up to where its reasons begin.
  if (!section.is_brief || section.warnings.size() < 2) return section.warnings;
  std::string all;
  for (const std::string& warning : section.warnings) {
    const std::size_t end =
        std::min({warning.find(": "), warning.find("; "), warning.find(" ("), warning.size()});
    all += (all.empty() ? "" : "; ") + warning.substr(0, end);
  }
  return {all};
}

std::vector<std::pair<std::string, std::string>> legend(const Section& section) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Table& table : section.tables) {
    if (!table.is_for_people) continue;
    for (const Column& column : table.columns) {
      const std::pair<std::string, std::string> line{shown_header(column),
                                                     section.is_brief ? column.brief : column.doc};
      // What is only in formats for programs needs no explanation here.
      const bool is_shown = column.place == Place::key || column.place == Place::value;
      if (!is_shown || line.second.empty()) continue;
      // Columns that several tables share are explained once.
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
  lines.insert(lines.end(), section.notes.begin(), section.notes.end());
  return lines;
}

}  // namespace avoidbench
