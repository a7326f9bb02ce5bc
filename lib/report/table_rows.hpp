#pragma once

// What the tables of a sweep are put together from, and their parts.

#include "report/summary.hpp"
#include "table/table.hpp"

namespace avoidbench {

void append(std::vector<Cell>& row, std::int64_t count);
void append(std::vector<Cell>& row, const std::string& words);
void append(std::vector<Cell>& row, double number, bool is_best = false);  ///< NaN: nothing
void append(std::vector<Cell>& row, const Interval& interval);             ///< two cells

Column planner_column();
Column machine_column(const std::string& name, const std::string& unit = "");

/// `name`_lower and `name`_upper: the interval of the column before.
void append_bounds(std::vector<Column>& columns, const std::string& name,
                   const std::string& unit = "");

/// `difficulty`, `flight_time` and `flight_time_curve`.
void append_response_tables(std::vector<Table>& tables, const SweepSummary& summary);

/// `maps` and `environment`.
void append_environment_tables(std::vector<Table>& tables, const SweepSummary& summary);

}  // namespace avoidbench
