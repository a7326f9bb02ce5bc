#include "report/table_rows.hpp"

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

}  // namespace avoidbench
