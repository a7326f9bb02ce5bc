#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/enum_text.hpp"
#include "table/table_value.hpp"

namespace avoidbench {

/// A number, a text, or nothing ("not defined": a dash for people, empty for machines).
struct Cell {
  TableValue value = {};
  bool is_best = false;  ///< shown with a star
};
using Row = std::vector<Cell>;

enum class Place {
  key,    ///< names the row: left-aligned
  value,  ///< a number or text
  /// Lower, then upper end of the interval of the value column before: in brackets beside it.
  bound,
  /// A text, left-aligned and never cut; wrapped where it is a list's last column.
  words,
  machine,  ///< left out of what people read
};

struct Column {
  std::string name;         ///< full, with unit, for machines: path_optimality_pct
  std::string header = {};  ///< short, for people: PO; "": the name
  std::string unit = {};    ///< for people, under the header; "" for none
  std::string doc = {};     ///< line of the legend; "" where the header says all
  Place place = Place::value;
  int decimals = -1;  ///< for people; -1: three significant digits of the column's greatest number
  bool has_interval = false;  ///< make_table() puts columns of its ends behind it
  /// What the header stands for, in a few words: the legend of a brief section. "": the header says
  /// it.
  std::string brief = {};
};

struct Table {
  std::string name;        ///< for machines: planners
  std::string title = {};  ///< for people; "": a list, which is header and rows and nothing else
  std::vector<Column> columns = {};
  std::vector<Row> rows = {};  ///< each as long as `columns`
  bool is_for_people = true;   ///< false: only in the formats for machines
};

/// The tables of one sweep with what stands around them.
struct Section {
  std::string name;  ///< of the sweep
  std::string title = {};
  std::vector<Table> tables = {};
  /// Further lines of the legend: sign, meaning.
  std::vector<std::pair<std::string, std::string>> notes = {};
  /// Before the tables. Each begins with what is the matter; details follow ": ", "; " or " (".
  std::vector<std::string> warnings = {};
  /// For people: one line of warnings without their details, one paragraph of Column::brief.
  bool is_brief = false;
  std::string footer = {};  ///< the last line on a terminal and in Markdown
};

enum class TableFormat { table, csv, json, markdown, latex };
template <>
struct EnumText<TableFormat> {
  static constexpr std::pair<TableFormat, std::string_view> entries[] = {
      {TableFormat::table, "table"},
      {TableFormat::csv, "csv"},
      {TableFormat::json, "json"},
      {TableFormat::markdown, "markdown"},
      {TableFormat::latex, "latex"}};
};

/// How text for a terminal is set.
struct TextStyle {
  std::size_t width = 100;  ///< columns; what does not fit goes on in a further block
  bool is_coloured = false;
};

/// The sections as text that ends with a newline.
/// - table: aligned, no wider than `style.width`;
/// - csv (csv.hpp, one header line): one value a line, `sweep,table,<keys>,name,unit,value`, where
///   the keys are every key column of any table, empty in tables without it; values with all
///   digits, empty where not defined;
/// - json: an array of {"sweep", "title", "warnings", "tables": {name: [{column: value, …}, …]},
///   "columns": …};
/// - markdown: pipe tables;
/// - latex: one table environment a table, set by booktabs (`\usepackage{booktabs}`), the legend in
///   comments before it.
std::string format_sections(std::span<const Section> sections, TableFormat format,
                            const TextStyle& style = {});

/// One table alone. For people as in a section; csv has a line a row, json is an array of objects.
std::string format_table(const Table& table, TableFormat format, const TextStyle& style = {});

}  // namespace avoidbench
