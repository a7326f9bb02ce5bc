#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/table.hpp"
#include "report/table_text.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::string_view kGap = "  ";

// ---- for people

std::size_t width_of(const TextColumn& column) {
  std::size_t width = std::max(display_width(column.header), display_width(column.unit));
  for (const std::string& cell : column.cells) width = std::max(width, display_width(cell));
  return width;
}

std::string aligned(const std::string& text, std::size_t width, bool is_left) {
  const std::string space(width - display_width(text), ' ');
  return is_left ? text + space : space + text;
}

/// Keys and as many columns from `first` on as fit; moves `first` behind them.
std::vector<std::size_t> next_block(const std::vector<TextColumn>& columns, std::size_t& first) {
  std::vector<std::size_t> block;
  std::size_t width = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].is_key) continue;
    block.push_back(i);
    width += width_of(columns[i]) + kGap.size();
  }
  const std::size_t key_count = block.size();
  for (; first < columns.size(); ++first) {
    if (columns[first].is_key) continue;
    const std::size_t more = width_of(columns[first]) + kGap.size();
    if (block.size() > key_count && width + more > kWidth + kGap.size()) break;
    block.push_back(first);
    width += more;
  }
  return block;
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line + "\n";
}

/// One line of a block, of a text from each column.
template <class TextOf>
std::string block_line(const std::vector<TextColumn>& columns,
                       const std::vector<std::size_t>& block, TextOf text_of) {
  std::string line;
  for (const std::size_t i : block) {
    line += (line.empty() ? "" : std::string(kGap)) +
            aligned(text_of(columns[i]), width_of(columns[i]), columns[i].is_key);
  }
  return line;
}

std::string table_text(const Table& table) {
  const std::vector<TextColumn> columns = text_columns(table);
  std::string out;
  for (std::size_t first = 0; first < columns.size();) {
    const std::vector<std::size_t> block = next_block(columns, first);
    out += table.title + (out.empty() ? "" : " (continued)") + "\n";
    append_line(out, block_line(columns, block, [](const TextColumn& c) { return c.header; }));
    const bool has_units = std::any_of(block.begin(), block.end(),
                                       [&](std::size_t i) { return !columns[i].unit.empty(); });
    if (has_units)
      append_line(out, block_line(columns, block, [](const TextColumn& c) { return c.unit; }));
    std::string rule;
    for (const std::size_t i : block) {
      if (!rule.empty()) rule += kGap;
      for (std::size_t n = 0; n < width_of(columns[i]); ++n) rule += "─";
    }
    out += rule + "\n";
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      // A key that repeats is shown once, so that the eye sees the groups; the last key names the
      // row and stays.
      bool repeats = row > 0;
      std::size_t keys_left = static_cast<std::size_t>(std::count_if(
          block.begin(), block.end(), [&](std::size_t i) { return columns[i].is_key; }));
      append_line(out, block_line(columns, block, [&](const TextColumn& c) -> std::string {
                    if (!c.is_key) return c.cells[row];
                    repeats = repeats && --keys_left > 0 && c.cells[row] == c.cells[row - 1];
                    return repeats ? "" : c.cells[row];
                  }));
    }
    out += "\n";
  }
  return out;
}

/// Every column's doc once: "PO   path optimality …".
std::vector<std::pair<std::string, std::string>> legend(const Section& section) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Table& table : section.tables) {
    for (const Column& column : table.columns) {
      const std::pair<std::string, std::string> line{column.header, column.doc};
      const bool is_shown = column.place == Place::key || column.place == Place::value;
      if (!is_shown || column.doc.empty()) continue;
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
  lines.insert(lines.end(), section.notes.begin(), section.notes.end());
  return lines;
}

std::string text_of(const Section& section) {
  std::string out = wrapped(section.title, kWidth, 2) + "\n\n";
  for (const std::string& warning : section.warnings) {
    out += wrapped("Warning: " + warning, kWidth, 9) + "\n";
  }
  if (!section.warnings.empty()) out += "\n";
  for (const Table& table : section.tables) out += table_text(table);
  const auto lines = legend(section);
  std::size_t header_width = 0;
  for (const auto& [header, doc] : lines)
    header_width = std::max(header_width, display_width(header));
  for (const auto& [header, doc] : lines) {
    out +=
        wrapped(aligned(header, header_width, true) + "  " + doc, kWidth, header_width + 2) + "\n";
  }
  return out;
}

std::string in_markdown(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_' || c == '<' || c == '\\') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string markdown_of(const Section& section) {
  std::string out = "## " + in_markdown(section.title) + "\n\n";
  for (const std::string& warning : section.warnings)
    out += "> **Warning:** " + in_markdown(warning) + "\n>\n";
  if (!section.warnings.empty()) out.replace(out.size() - 2, 2, "\n");
  for (const Table& table : section.tables) {
    out += "### " + in_markdown(table.title) + "\n\n|";
    const std::vector<TextColumn> columns = text_columns(table);
    for (const TextColumn& column : columns) {
      out +=
          " " + in_markdown(column.header + (column.unit.empty() ? "" : ", " + column.unit)) + " |";
    }
    out += "\n|";
    for (const TextColumn& column : columns) out += column.is_key ? ":--|" : "--:|";
    out += "\n";
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      out += "|";
      for (const TextColumn& column : columns) out += " " + in_markdown(column.cells[row]) + " |";
      out += "\n";
    }
    out += "\n";
  }
  for (const auto& [header, doc] : legend(section)) {
    out += "- **" + in_markdown(header) + "** " + in_markdown(doc) + "\n";
  }
  return out;
}

// ---- for machines

std::string exact(const Cell& cell) {
  if (const auto* words = std::get_if<std::string>(&cell.value)) return *words;
  if (const auto* count = std::get_if<std::int64_t>(&cell.value)) return std::to_string(*count);
  const auto* value = std::get_if<double>(&cell.value);
  if (value == nullptr || std::isnan(*value)) return "";
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), *value);
  return {buffer.data(), result.ptr};
}

std::string in_csv(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::vector<std::string> key_names(std::span<const Section> sections) {
  std::vector<std::string> names;
  for (const Section& section : sections) {
    for (const Table& table : section.tables) {
      for (const Column& column : table.columns) {
        if (column.place != Place::key) continue;
        if (std::find(names.begin(), names.end(), column.name) == names.end())
          names.push_back(column.name);
      }
    }
  }
  return names;
}

std::string csv_of(std::span<const Section> sections) {
  const std::vector<std::string> keys = key_names(sections);
  std::string out = "sweep,table";
  for (const std::string& key : keys) out += "," + in_csv(key);
  out += ",name,unit,value\n";
  for (const Section& section : sections) {
    for (const Table& table : section.tables) {
      for (const std::vector<Cell>& row : table.rows) {
        std::string start = in_csv(section.name) + "," + in_csv(table.name);
        for (const std::string& key : keys) {
          start += ",";
          for (std::size_t i = 0; i < row.size(); ++i) {
            if (table.columns[i].name == key) start += in_csv(exact(row[i]));
          }
        }
        for (std::size_t i = 0; i < row.size(); ++i) {
          const Column& column = table.columns[i];
          if (column.place == Place::key) continue;
          out += start + "," + in_csv(column.name) + "," + in_csv(column.unit) + "," +
                 in_csv(exact(row[i])) + "\n";
        }
      }
    }
  }
  return out;
}

nlohmann::ordered_json json_of(const Cell& cell) {
  if (const auto* words = std::get_if<std::string>(&cell.value)) return *words;
  if (const auto* count = std::get_if<std::int64_t>(&cell.value)) return *count;
  const auto* value = std::get_if<double>(&cell.value);
  if (value == nullptr || !std::isfinite(*value)) return nullptr;
  return *value;
}

nlohmann::ordered_json json_of(const Section& section) {
  nlohmann::ordered_json tables = nlohmann::ordered_json::object();
  nlohmann::ordered_json columns = nlohmann::ordered_json::object();
  for (const Table& table : section.tables) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const std::vector<Cell>& cells : table.rows) {
      nlohmann::ordered_json row = nlohmann::ordered_json::object();
      for (std::size_t i = 0; i < cells.size(); ++i) row[table.columns[i].name] = json_of(cells[i]);
      rows.push_back(std::move(row));
    }
    tables[table.name] = std::move(rows);
    for (const Column& column : table.columns) {
      columns[column.name] = {{"unit", column.unit}, {"doc", column.doc}};
    }
  }
  return {{"sweep", section.name},
          {"title", section.title},
          {"warnings", section.warnings},
          {"tables", tables},
          {"columns", columns}};
}

}  // namespace

std::string format_sections(std::span<const Section> sections, TableFormat format) {
  std::string out;
  switch (format) {
    case TableFormat::table:
      for (const Section& section : sections) out += (out.empty() ? "" : "\n") + text_of(section);
      return out;
    case TableFormat::markdown:
      for (const Section& section : sections)
        out += (out.empty() ? "" : "\n") + markdown_of(section);
      return out;
    case TableFormat::csv:
      return csv_of(sections);
    case TableFormat::json: {
      nlohmann::ordered_json all = nlohmann::ordered_json::array();
      for (const Section& section : sections) all.push_back(json_of(section));
      return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    }
  }
  return out;
}

}  // namespace avoidbench
