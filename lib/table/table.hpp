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

enum class Place {
  key,    ///< names the row: left-aligned
  value,  ///< a number or text
  /// Lower, then upper end of the interval of the value column before: in brackets beside it.
  bound,
  machine,  ///< left out of what people read
};

struct Column {
  std::string name;    ///< full, with unit, for machines: path_optimality_pct
  std::string header;  ///< short, for people: PO
  std::string unit;    ///< for people, under the header; "" for none
  std::string doc;     ///< line of the legend; "" where the header says all
  Place place = Place::value;
  int decimals = -1;  ///< for people; -1: three significant digits of the column's greatest number
};

struct Table {
  std::string name;   ///< for machines: planners
  std::string title;  ///< for people
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
  bool is_for_people = true;            ///< false: only in the formats for machines
};

/// The tables of one sweep with what stands around them.
struct Section {
  std::string name;  ///< of the sweep
  std::string title;
  std::vector<Table> tables;
  std::vector<std::pair<std::string, std::string>>
      notes;                          ///< further lines of the legend: sign, meaning
  std::vector<std::string> warnings;  ///< before the tables
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
/// - csv (RFC 4180, one header line): one value a line, `sweep,table,<keys>,name,unit,value`, where
/// the keys are every key
///   column of any table, empty in tables without it; values with all digits, empty where not
///   defined;
/// - json: an array of {"sweep", "title", "warnings", "tables": {name: [{column: value, …}, …]},
/// "columns": …};
/// - markdown: pipe tables;
/// - latex: one table environment a table, set by booktabs (`\usepackage{booktabs}`), the legend in
/// its caption.
std::string format_sections(std::span<const Section> sections, TableFormat format,
                            const TextStyle& style = {});

}  // namespace avoidbench
