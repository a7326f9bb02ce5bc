#pragma once

#include "report/summary.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// Names of the tables that a sweep can have: `speed` and `speed_curve` (v90 and what it is read
/// from), `limit_speeds`, `limits`, `limit_pairs` and `limit_curve` (of a sweep that looks for
/// limits, which has no others), `planners` (rates and means), `groups` (the same by
/// traversability), `grouped` (by the columns that were asked for), `outcomes` (counts), `pairs`
/// (contrast factors), `difficulty` (success against traversability), `flight_time` and
/// `flight_time_curve` (times to the goal), `maps`, `environment` (how their measures go together).
std::vector<std::string> table_names();

/// How much of a report people see.
enum class Detail {
  /// `speed`, `planners`, `outcomes`, `pairs`, and groups if each has several maps; a short legend
  brief,
  all  ///< every table but the long ones, `speed_curve`, `flight_time_curve` and `maps`
};

/// A sweep's tables: those named, with the full legend, or all, of which people see what `detail`
/// says.
Section sweep_section(const SweepSummary& summary, std::span<const std::string> tables = {},
                      Detail detail = Detail::all);

/// Every sweep's planners in one table; the summaries have the same metrics.
Section side_by_side(std::span<const SweepSummary> summaries, Detail detail = Detail::all);

/// Pairs of planners that a report shows to people: of 20 planners there are 190, of 500 124,750.
inline constexpr std::size_t kMostShownPairs = 200;

/// Whether it is `pairs` or `limit_pairs` with more than that: shown only where it is asked for by
/// name.
bool is_left_out(const Table& table);

/// Causes of failures, as the table `causes` of a sweep has them.
Table causes_table(std::span<const CauseCount> counts, std::span<const std::string> planners);
/// What the causes in it mean, for the legend.
std::vector<std::pair<std::string, std::string>> cause_notes(std::span<const CauseCount> counts);

}  // namespace avoidbench
