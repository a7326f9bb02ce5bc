#include "report/table_rows.hpp"

#include <cmath>

namespace avoidbench {

void append(std::vector<Cell>& row, std::int64_t count) { row.emplace_back().value = count; }

void append(std::vector<Cell>& row, const std::string& words) { row.emplace_back().value = words; }

void append(std::vector<Cell>& row, double number, bool is_best) {
  Cell& cell = row.emplace_back();
  if (!std::isnan(number)) cell.value = number;
  cell.is_best = is_best;
}

void append(std::vector<Cell>& row, const Interval& interval) {
  append(row, interval.lower);
  append(row, interval.upper);
}

Column planner_column() {
  return {.name = "planner", .header = "planner", .unit = "", .doc = "", .place = Place::key};
}

Column machine_column(const std::string& name, const std::string& unit) {
  return {.name = name, .header = "", .unit = unit, .doc = "", .place = Place::machine};
}

void append_bounds(std::vector<Column>& columns, const std::string& name, const std::string& unit) {
  for (const char* suffix : {"_lower", "_upper"}) {
    columns.push_back(
        {.name = name + suffix, .header = "", .unit = unit, .doc = "", .place = Place::bound});
  }
}

}  // namespace avoidbench
