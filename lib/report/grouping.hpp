#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/planner_summary.hpp"

namespace avoidbench {

/// One column to group trials by: a field as it is, or its range cut into `bin_count` groups of
/// equal map count.
struct GroupColumn {
  std::string field;
  std::size_t bin_count = 0;  ///< 0: each value is a group
};

/// `FIELD` or `FIELD/5`. Throws InputError for anything else.
GroupColumn parse_group_column(const std::string& text);

/// Trials that have the same in every column.
struct GroupedTrials {
  std::vector<TableValue> keys;  ///< one a column; the range as text where it was cut
  Trials trials;
};

/// The groups of `trials`, ordered by the columns' values, the first column first. Every column's
/// field is one of `result.fields`. Throws InputError when a range is to be cut whose values are no
/// numbers, or when there are more than 1,000 groups.
std::vector<GroupedTrials> group_trials(const SweepResult& result, const Trials& trials,
                                        const std::vector<GroupColumn>& columns);

/// `0.532–0.611`.
std::string range_text(double lowest, double highest);

}  // namespace avoidbench
