#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "table/csv.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

/// Columns that name a row, in order of first use; the header has those of all tables.
std::vector<std::string> key_names(std::span<const Section> sections) {
  std::vector<std::string> names;
  for (const Section& section : sections) {
    for (const Table& table : section.tables) {
      for (const Column& column : table.columns) {
        const bool is_new = column.place == Place::key && !contains(names, column.name);
        if (is_new) names.push_back(column.name);
      }
    }
  }
  return names;
}

/// Long form: a line a number, with the keys of its row. Tables of unlike columns then share one
/// file.
std::string csv_of(std::span<const Section> sections) {
  const std::vector<std::string> keys = key_names(sections);
  CsvRow header;
  header.add_words({"sweep", "table"});
  for (const std::string& key : keys) header.add(key);
  std::string out = header.add_words({"name", "unit", "value"}).line();
  for (const Section& section : sections) {
    for (const Table& table : section.tables) {
      for (const Row& row : table.rows) {
        // The beginning that all numbers of the row share.
        CsvRow start;
        start.add_words({section.name, table.name});
        for (const std::string& key : keys) {
          const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                           [&](const Column& one) { return one.name == key; });
          const auto i = static_cast<std::size_t>(column - table.columns.begin());
          // An empty field for a key that this table lacks.
          start.add_value(i < row.size() ? row[i].value : TableValue{});
        }
        for (std::size_t i = 0; i < row.size(); ++i) {
          const Column& column = table.columns[i];
          if (column.place == Place::key) continue;
          out += CsvRow(start).add_words({column.name, column.unit}).add_value(row[i].value).line();
        }
      }
    }
  }
  return out;
}

nlohmann::ordered_json json_of(const Cell& cell) {
  if (const auto* words = std::get_if<std::string>(&cell.value)) return *words;
  if (const auto* count = std::get_if<std::int64_t>(&cell.value)) return *count;
  if (const auto* seed = std::get_if<std::uint64_t>(&cell.value)) return *seed;
  const auto* value = std::get_if<double>(&cell.value);
  // JSON has neither NaN nor infinity.
  if (value == nullptr || !std::isfinite(*value)) return nullptr;
  return *value;
}

nlohmann::ordered_json rows_json(const Table& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Row& cells : table.rows) {
    nlohmann::ordered_json row = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < cells.size(); ++i) row[table.columns[i].name] = json_of(cells[i]);
    rows.push_back(std::move(row));
  }
  return rows;
}

nlohmann::ordered_json json_of(const Section& section) {
  nlohmann::ordered_json tables = nlohmann::ordered_json::object();
  nlohmann::ordered_json columns = nlohmann::ordered_json::object();
  for (const Table& table : section.tables) {
    tables[table.name] = rows_json(table);
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

std::string csv_of(const Table& table) {
  CsvRow header;
  for (const Column& column : table.columns) header.add(column.name);
  std::string out = header.line();
  for (const Row& cells : table.rows) {
    CsvRow row;
    for (const Cell& cell : cells) row.add_value(cell.value);
    out += row.line();
  }
  return out;
}

/// The section as people may see it: each text on one line, without control characters.
Section visible_section(Section section) {
  section.name = visible_line(section.name);
  section.title = visible_line(section.title);
  section.footer = visible_line(section.footer);
  for (std::string& warning : section.warnings) warning = visible_line(warning);
  for (auto& [sign, meaning] : section.notes) {
    sign = visible_line(sign);
    meaning = visible_line(meaning);
  }
  for (Table& table : section.tables) {
    table.title = visible_line(table.title);
    for (Column& column : table.columns) {
      column.header = visible_line(column.header);
      column.unit = visible_line(column.unit);
      column.doc = visible_line(column.doc);
      column.brief = visible_line(column.brief);
    }
    for (Row& row : table.rows) {
      for (Cell& cell : row) {
        if (auto* words = std::get_if<std::string>(&cell.value)) *words = visible_line(*words);
      }
    }
  }
  return section;
}

}  // namespace

std::string dumped(const nlohmann::ordered_json& json) {
  // Bytes that are no UTF-8 (of labels, of file names) are replaced and do not throw.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string format_sections(std::span<const Section> sections, TableFormat format,
                            const TextStyle& style) {
  std::string out;
  if (format == TableFormat::csv) return csv_of(sections);
  if (format == TableFormat::json) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const Section& section : sections) all.push_back(json_of(section));
    return dumped(all);
  }
  // Data formats have texts as they are; what people see in a terminal is made safe.
  for (const Section& given : sections) {
    const Section section = visible_section(given);
    if (!out.empty()) out += "\n";
    if (format == TableFormat::table) out += terminal_text(section, style);
    if (format == TableFormat::markdown) out += markdown_text(section);
    if (format == TableFormat::latex) out += latex_text(section);
  }
  return out;
}

std::string format_table(const Table& table, TableFormat format, const TextStyle& style) {
  if (format == TableFormat::csv) return csv_of(table);
  if (format == TableFormat::json) return dumped(rows_json(table));
  // A table without a title is a list: no heading.
  const Section section{.name = {}, .tables = {table}};
  return format_sections({&section, 1}, format, style);
}

}  // namespace avoidbench
