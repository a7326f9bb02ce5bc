#pragma once

#include "report/summary.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// Names of the tables that a sweep can have: `planners` (rates and means), `groups` (the same by
/// traversability), `grouped` (by the columns that were asked for), `outcomes` (counts), `pairs`
/// (contrast factors), `difficulty` (success against traversability), `flight_time` and
/// `flight_time_curve` (times to the goal), `maps`, `environment` (how their measures go together).
std::vector<std::string> table_names();

/// A sweep's tables: those named, or all, of which `flight_time_curve`, `maps` and `environment`
/// are then for machines only.
Section sweep_section(const SweepSummary& summary, std::span<const std::string> tables = {});

/// Tables of sweep_section(): success against traversability, times to the goal and the share that
/// has arrived over time, the maps, and how their measures go together.
Table difficulty_table(const SweepSummary& summary);
Table flight_time_table(const SweepSummary& summary);
Table flight_time_curve_table(const SweepSummary& summary);
Table map_table(const SweepSummary& summary);
Table correlation_table(const SweepSummary& summary);

/// Every sweep's planners in one table; the summaries have the same metrics.
Section side_by_side(std::span<const SweepSummary> summaries);

}  // namespace avoidbench
