#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "store/rows.hpp"

namespace avoidbench {

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

/// Throws OptionError, with the values that there are, where `=` or `!=` names a value that no
/// trial of any of these results has: it was misspelled, and would choose nothing or everything.
void check_values(std::span<const SweepResult* const> results,
                  const std::vector<Condition>& conditions);

/// The result with only those trials for which every condition holds, and the maps and planners
/// that they have. Every condition's field is one of `result.fields`.
SweepResult selected(SweepResult result, const std::vector<Condition>& conditions);

}  // namespace avoidbench
