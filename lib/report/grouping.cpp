#include "report/grouping.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "base/check.hpp"
#include "base/option_error.hpp"
#include "text/number_text.hpp"

namespace avoidbench {
namespace {

/// More are a slip, such as grouping by a measured number.
constexpr std::size_t kMostGroups = 1000;

double number_of(const TableValue& value, const std::string& field) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  throw OptionError(field + "/…: not all of its values are numbers", "group-by");
}

/// A column's way from a trial's value to the group's place and name.
struct Binning {
  std::size_t field = 0;            // index into the trials' fields
  std::vector<double> last_values;  // greatest value of each bin; empty: values as they are
  std::vector<TableValue> names;

  TableValue place(const TrialSummary& trial, const std::string& name) const {
    const TableValue& value = trial.fields[field];
    // No value is a group of its own.
    if (last_values.empty() || std::holds_alternative<std::monostate>(value)) return value;
    // The first bin whose greatest value is not below: bins are closed above.
    const auto bin =
        std::lower_bound(last_values.begin(), last_values.end(), number_of(value, name));
    return static_cast<std::int64_t>(bin - last_values.begin());
  }
  TableValue name(const TableValue& place) const {
    const auto* bin = std::get_if<std::int64_t>(&place);
    return last_values.empty() || bin == nullptr ? place : names[static_cast<std::size_t>(*bin)];
  }
};

/// How a column's values become keys: as they are, or by bins of about equal count.
Binning binning_of(const SweepResult& result, const Trials& trials, const GroupColumn& column) {
  Binning binning;
  const auto found = std::find(result.fields.begin(), result.fields.end(), column.field);
  AB_CHECK(found != result.fields.end());
  binning.field = static_cast<std::size_t>(found - result.fields.begin());
  if (column.bin_count == 0) return binning;
  // A value counts once a map, so that a measure of maps is cut into groups of equal map count.
  std::set<std::pair<double, std::size_t>> values;
  for (const TrialOnMap& on_map : trials) {
    const TableValue& value = on_map.trial->fields[binning.field];
    if (std::holds_alternative<std::monostate>(value)) continue;
    values.emplace(number_of(value, column.field), on_map.map);
  }
  std::vector<double> sorted;
  for (const auto& [value, map] : values) sorted.push_back(value);
  // Fewer values than bins: one value a bin.
  const std::size_t bin_count = std::min(column.bin_count, sorted.size());
  std::size_t first = 0;
  for (std::size_t bin = 0; bin < bin_count; ++bin) {
    // Bin k ends at the (k + 1)/n-th value, rounded up, unless ties have taken more than that.
    std::size_t end = std::max(first, ((bin + 1) * sorted.size() + bin_count - 1) / bin_count);
    // Values that are equal never end up in two bins.
    while (end > first && end < sorted.size() && sorted[end] == sorted[end - 1])
      ++end;  // ties stay
    // Ties of the bin before took all of this one.
    if (end == first) continue;
    binning.last_values.push_back(sorted[end - 1]);
    binning.names.emplace_back(range_text(sorted[first], sorted[end - 1]));
    first = end;
  }
  return binning;
}

}  // namespace

GroupColumn parse_group_column(const std::string& text) {
  GroupColumn column;
  const std::size_t slash = text.find('/');
  column.field = text.substr(0, slash);
  if (column.field.empty())
    throw OptionError("'" + text + "': a column's name is missing", "group-by");
  if (slash == std::string::npos) return column;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + slash + 1, end, column.bin_count);
  if (error != std::errc{} || rest != end || column.bin_count < 2 || column.bin_count > 100) {
    throw OptionError(text + ": after / comes a number of groups from 2 to 100", "group-by");
  }
  return column;
}

std::vector<GroupedTrials> group_trials(const SweepResult& result, const Trials& trials,
                                        const std::vector<GroupColumn>& columns) {
  std::vector<Binning> binnings;
  for (const GroupColumn& column : columns) {
    binnings.push_back(binning_of(result, trials, column));
  }
  // The map's order is that of the table: by the first column, then the second, …
  std::map<std::vector<TableValue>, Trials> by_place;
  for (const TrialOnMap& on_map : trials) {
    std::vector<TableValue> place;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      place.push_back(binnings[i].place(*on_map.trial, columns[i].field));
    }
    by_place[place].push_back(on_map);
    // Within the loop, so that a million groups are never made.
    if (by_place.size() > kMostGroups) {
      throw OptionError(columns.back().field + ": more than " + std::to_string(kMostGroups) +
                            " groups; " + columns.back().field + "/5 makes five of equal map count",
                        "group-by");
    }
  }
  std::vector<GroupedTrials> groups;
  for (auto& [place, of_place] : by_place) {
    GroupedTrials group{.keys = {}, .trials = std::move(of_place)};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      group.keys.push_back(binnings[i].name(place[i]));
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

std::string range_text(double lowest, double highest) {
  // Ratios and metres with three decimals, counts and other large numbers with one.
  const int decimals = std::max(std::abs(lowest), std::abs(highest)) < 10.0 ? 3 : 1;
  return fixed_digits(lowest, decimals) + "–" + fixed_digits(highest, decimals);
}

}  // namespace avoidbench
