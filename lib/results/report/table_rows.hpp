#pragma once

// What tables are put together from.

#include <cmath>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "table/table.hpp"

namespace avoidbench {

/// A table without rows. Behind each column that has an interval stand those of its ends,
/// NAME_lower and NAME_upper.
Table make_table(std::string name, std::string title, const std::vector<Column>& columns);

/// A list of texts without rows (Place::words), as commands print them that show no results.
Table make_list(const std::vector<std::string>& columns);

/// The column `planner`, and one that people do not see.
Column planner_column();
Column machine_column(const std::string& name, const std::string& unit = "");

/// The number of columns where none has the name.
std::size_t column_at(const Table& table, std::string_view name);
/// Takes a column out of the table that is there.
void drop_column(Table& table, std::size_t at);
/// Takes out the column of this name if no row has a value in it.
void drop_if_empty(Table& table, std::string_view name);

/// Appends what is given: a cell, a row, an interval (two cells), a number (NaN: nothing) or a
/// text.
template <class Part>
void append(Row& row, const Part& part) {
  if constexpr (std::same_as<Part, Cell>) {
    row.push_back(part);
  } else if constexpr (std::same_as<Part, Row>) {
    row.insert(row.end(), part.begin(), part.end());
  } else if constexpr (requires { part.lower, part.upper; }) {
    append(row, part.lower);
    append(row, part.upper);
  } else if constexpr (std::floating_point<Part>) {
    row.emplace_back();
    if (!std::isnan(part)) row.back().value = part;
  } else if constexpr (std::unsigned_integral<Part>) {
    row.push_back({.value = static_cast<std::uint64_t>(part)});
  } else if constexpr (std::integral<Part>) {
    row.push_back({.value = static_cast<std::int64_t>(part)});
  } else {
    row.push_back({.value = std::string(part)});
  }
}

/// A number, with a star where it is the best; NaN: nothing.
inline Cell best_cell(double number, bool is_best) {
  return {.value = std::isnan(number) ? TableValue() : TableValue(number), .is_best = is_best};
}

/// A row of these parts, as append() takes them.
template <class... Parts>
Row make_row(const Parts&... parts) {
  Row row;
  (append(row, parts), ...);
  return row;
}

}  // namespace avoidbench
