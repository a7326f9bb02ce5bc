#include "report/table_rows.hpp"

#include <algorithm>

namespace avoidbench {

Table make_table(std::string name, std::string title, const std::vector<Column>& columns) {
  Table table{.name = std::move(name), .title = std::move(title)};
  // A column with an interval is three: the value and its two ends.
  for (const Column& column : columns) {
    table.columns.push_back(column);
    if (!column.has_interval) continue;
    for (const char* suffix : {"_lower", "_upper"}) {
      table.columns.push_back(
          {.name = column.name + suffix, .unit = column.unit, .place = Place::bound});
    }
  }
  return table;
}

Table make_list(const std::vector<std::string>& columns) {
  Table table{.name = "list"};
  for (const std::string& name : columns) {
    table.columns.push_back({.name = name, .place = Place::words});
  }
  return table;
}

Column planner_column() { return {.name = "planner", .place = Place::key}; }

Column machine_column(const std::string& name, const std::string& unit) {
  return {.name = name, .unit = unit, .place = Place::machine};
}

std::size_t column_at(const Table& table, std::string_view name) {
  const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                  [&](const Column& column) { return column.name == name; });
  return static_cast<std::size_t>(found - table.columns.begin());
}

void drop_column(Table& table, std::size_t at) {
  const auto offset = static_cast<std::ptrdiff_t>(at);
  table.columns.erase(table.columns.begin() + offset);
  for (Row& row : table.rows) row.erase(row.begin() + offset);
}

void drop_if_empty(Table& table, std::string_view name) {
  const std::size_t at = column_at(table, name);
  const bool is_empty = std::all_of(table.rows.begin(), table.rows.end(), [&](const Row& row) {
    // make_row() makes no value of NaN.
    return std::holds_alternative<std::monostate>(row[at].value);
  });
  if (is_empty && !table.rows.empty()) drop_column(table, at);
}

}  // namespace avoidbench
