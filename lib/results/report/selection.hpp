#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/planner_summary.hpp"
#include "store/database.hpp"

namespace avoidbench {

/// The revisions of sweeps that `wanted` means, in each database those with finished trials: "" the
/// latest revision of every sweep, NAME the latest of that name, NAME@2 its revision 2. Throws
/// InputError where no database has a finished trial of it. Sweeps that are wanted and have none go
/// to `unflown`, a line each.
std::vector<std::vector<SweepInfo>> chosen_sweeps(std::span<const Database> databases,
                                                  std::string_view wanted,
                                                  std::vector<std::string>* unflown = nullptr);

/// The place of a field that is one of these.
std::size_t place_of(const std::string& field, const std::vector<std::string>& fields);

/// What a trial's field must be to be reported: `map.poisson_radius_m < 3`, `planner = ego, mine`.
struct Condition {
  enum class Comparison { equal, unequal, less, at_most, greater, at_least };

  std::string field;
  Comparison comparison = Comparison::equal;
  /// A value as it was written, which is what texts are compared with, and as a number if it is
  /// one: a label may well be `2`.
  struct Value {
    std::string word;
    std::optional<double> number;
  };
  std::vector<Value> values;  ///< equal: to one of them; unequal: to all of them; else one
  std::string text;           ///< as it was written
};

/// Reads FIELD OP VALUE with OP one of = (or ==) != < <= > >=; = and != take several values,
/// separated by commas. Throws InputError for anything else.
Condition parse_condition(const std::string& text);

/// Numbers compare as numbers, whole or not; a text equals the value as it was written, and is
/// never less or greater than a number. A field without value fulfils != only.
bool holds(const Condition& condition, const TableValue& value);

/// Throws OptionError, with the values that there are, where `=` or `!=` names a value that is none
/// of `there`: it was misspelled, and would choose nothing or everything.
void check_values(const Condition& condition, const std::set<TableValue>& there);

/// The same for what the trials of these results have.
void check_values(std::span<const SweepResult* const> results,
                  const std::vector<Condition>& conditions);

/// The result with only those trials for which every condition holds, and the maps and planners
/// that they have. Every condition's field is one of `result.fields`.
SweepResult selected(SweepResult result, const std::vector<Condition>& conditions);

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
