#include "report/selection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/check.hpp"
#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

using Comparison = Condition::Comparison;

constexpr std::pair<std::string_view, Comparison> kSigns[] = {  // the longer before the shorter
    {"==", Comparison::equal},    {"!=", Comparison::unequal}, {"<=", Comparison::at_most},
    {">=", Comparison::at_least}, {"=", Comparison::equal},    {"<", Comparison::less},
    {">", Comparison::greater}};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Truth values are numbers in the results.
Condition::Value value_of(const std::string& word) {
  if (word == "true") return {.word = word, .number = 1.0};
  if (word == "false") return {.word = word, .number = 0.0};
  return {.word = word, .number = number_from<double>(word)};
}

/// Numbers by value, whichever way they are held.
/// "3" and "3.0" are one number; words are compared as words, also "007".
bool is_equal(const TableValue& value, const Condition::Value& wanted) {
  if (const auto* words = std::get_if<std::string>(&value)) return *words == wanted.word;
  const std::optional<double> number = number_in(value);
  return number && number == wanted.number;
}

/// More are a slip, such as grouping by a measured number.
constexpr std::size_t kMostGroups = 1000;

double number_of(const TableValue& value, const std::string& field) {
  const std::optional<double> number = number_in(value);
  if (!number) throw OptionError(field + "/…: not all of its values are numbers", "group-by");
  return *number;
}

/// What groups stand in order by, and what they are called.
using PlaceAndName = std::pair<TableValue, TableValue>;

/// A column's way from a trial's value to the group's place and name.
struct Binning {
  std::size_t field = 0;            // index into the trials' fields
  std::vector<double> last_values;  // greatest value of each bin; empty: values as they are
  std::vector<TableValue> names;

  PlaceAndName group_of(const TrialSummary& trial, const std::string& column) const {
    const TableValue& value = trial.fields[field];
    // No value is a group of its own.
    if (last_values.empty() || std::holds_alternative<std::monostate>(value)) return {value, value};
    // The first bin whose greatest value is not below: bins are closed above.
    const auto bin =
        std::lower_bound(last_values.begin(), last_values.end(), number_of(value, column)) -
        last_values.begin();
    return {static_cast<std::int64_t>(bin), names[static_cast<std::size_t>(bin)]};
  }
};

/// How a column's values become keys: as they are, or by bins of about equal count.
Binning binning_of(const SweepResult& result, const Trials& trials, const GroupColumn& column) {
  Binning binning;
  binning.field = place_of(column.field, result.fields);
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
    while (end > first && end < sorted.size() && sorted[end] == sorted[end - 1]) ++end;
    // Ties of the bin before took all of this one.
    if (end == first) continue;
    binning.last_values.push_back(sorted[end - 1]);
    binning.names.emplace_back(range_text(sorted[first], sorted[end - 1]));
    first = end;
  }
  return binning;
}

}  // namespace

std::size_t place_of(const std::string& field, const std::vector<std::string>& fields) {
  const auto place = place_in(fields, field);
  AB_CHECK(place.has_value(), field);
  return *place;
}

std::vector<std::vector<SweepInfo>> chosen_sweeps(std::span<const Database> databases,
                                                  std::string_view wanted,
                                                  std::vector<std::string>* unflown) {
  std::vector<std::vector<SweepInfo>> chosen;
  std::vector<std::string> names;
  bool is_known = false, has_trials = false;
  for (const Database& database : databases) {
    const std::vector<SweepInfo> sweeps = database.read_sweeps();  // by name, then revision
    std::vector<SweepInfo>& of_this = chosen.emplace_back();
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      // The last of its name: older revisions are taken only where one is named.
      const bool is_latest = i + 1 == sweeps.size() || sweeps[i + 1].name != sweeps[i].name;
      const std::string exact = sweeps[i].name + "@" + std::to_string(sweeps[i].revision);
      // What one may type, for the hint.
      names.push_back(is_latest ? sweeps[i].name : exact);
      const bool is_wanted =
          wanted == exact || (is_latest && (wanted.empty() || wanted == sweeps[i].name));
      is_known = is_known || is_wanted;
      if (!is_wanted) continue;
      if (sweeps[i].trial_count > 0) {
        has_trials = true;
        of_this.push_back(sweeps[i]);
      } else if (unflown != nullptr) {
        unflown->push_back(database.path().string() + ": sweep " + sweeps[i].name +
                           " has no finished trial yet");
      }
    }
  }
  if (!is_known && !wanted.empty()) {
    const std::string name(wanted);
    throw InputError("no sweep " + name + did_you_mean(name, names));
  }
  if (!has_trials) throw InputError("no finished trial");
  return chosen;
}

Condition parse_condition(const std::string& text) {
  Condition condition;
  condition.text = trimmed(text);
  // A field's name has none of these signs: what is before the first of them is the field.
  const std::size_t at = text.find_first_of("=!<>");
  // The longer signs stand first in the list, so "<=" is not taken for "<".
  const auto* const sign =
      std::find_if(std::begin(kSigns), std::end(kSigns), [&](const auto& candidate) {
        return at != std::string::npos &&
               text.compare(at, candidate.first.size(), candidate.first) == 0;
      });
  condition.field = trimmed(text.substr(0, at));
  if (sign == std::end(kSigns) || condition.field.empty()) {
    throw OptionError("'" + text +
                          "': a condition is FIELD OP VALUE, OP one of = == != < <= > >=, such as "
                          "'map.poisson_radius_m < 3' or 'planner = ego, reactive'",
                      "where");
  }
  condition.comparison = sign->second;
  const bool takes_several =
      condition.comparison == Comparison::equal || condition.comparison == Comparison::unequal;
  std::string rest = text.substr(at + sign->first.size());
  while (true) {
    // Several values mean "one of them" (or none of them); an inequality has one limit.
    const std::size_t comma = takes_several ? rest.find(',') : std::string::npos;
    const std::string word = trimmed(rest.substr(0, comma));
    if (word.empty()) throw OptionError("'" + text + "': a value is missing", "where");
    condition.values.push_back(value_of(word));
    if (comma == std::string::npos) break;
    rest.erase(0, comma + 1);
  }
  if (!takes_several && !condition.values.front().number) {
    throw OptionError("'" + text + "': " + std::string(sign->first) + " compares with a number",
                      "where");
  }
  return condition;
}

bool holds(const Condition& condition, const TableValue& value) {
  const bool is_one_of =
      std::any_of(condition.values.begin(), condition.values.end(),
                  [&](const Condition::Value& wanted) { return is_equal(value, wanted); });
  if (condition.comparison == Comparison::equal) return is_one_of;
  if (condition.comparison == Comparison::unequal) return !is_one_of;
  const std::optional<double> number = number_in(value);
  // Nothing and texts are neither below nor above a number.
  if (!number) return false;
  const double limit = condition.values.front().number.value();
  if (condition.comparison == Comparison::less) return *number < limit;
  if (condition.comparison == Comparison::at_most) return *number <= limit;
  return condition.comparison == Comparison::greater ? *number > limit : *number >= limit;
}

void check_values(const Condition& condition, const std::set<TableValue>& there) {
  constexpr std::size_t kMostShown = 12;
  const bool is_by_value =
      condition.comparison == Comparison::equal || condition.comparison == Comparison::unequal;
  if (!is_by_value) return;
  for (const Condition::Value& value : condition.values) {
    const auto is_meant = [&](const TableValue& one) { return is_equal(one, value); };
    if (std::any_of(there.begin(), there.end(), is_meant)) continue;
    std::vector<std::string> words;
    for (const TableValue& one : there) {
      if (std::holds_alternative<std::monostate>(one)) continue;
      const std::optional<double> number = number_in(one);
      words.push_back(number ? shortest(*number) : text_of(one));
    }
    const std::string near = did_you_mean(value.word, words);
    const std::size_t count = words.size();
    words.resize(std::min(kMostShown, count));
    throw OptionError("'" + condition.text + "': no trial has " + value.word + near +
                          "; there are: " + joined(words) + (count > kMostShown ? ", …" : ""),
                      "where");
  }
}

/// Without this, a condition with `=` would leave nothing and one with `!=` leave out nothing, both
/// in silence.
void check_values(std::span<const SweepResult* const> results,
                  const std::vector<Condition>& conditions) {
  for (const Condition& condition : conditions) {
    std::set<TableValue> there;
    for (const SweepResult* result : results) {
      const std::size_t field = place_of(condition.field, result->fields);
      for (const TrialSummary& trial : result->trials) there.insert(trial.fields[field]);
    }
    check_values(condition, there);
  }
}

SweepResult selected(SweepResult result, const std::vector<Condition>& conditions) {
  std::set<std::string> maps, planners;
  for (const Condition& condition : conditions) {
    // Conditions hold together: each takes out what it refuses.
    const std::size_t field = place_of(condition.field, result.fields);
    std::erase_if(result.trials, [&](const TrialSummary& trial) {
      return !holds(condition, trial.fields[field]);
    });
  }
  if (conditions.empty()) return result;
  for (const TrialSummary& trial : result.trials) {
    maps.insert(trial.map_key);
    planners.insert(trial.planner_key);
  }
  // Maps and planners without a trial that is left would stand in tables with zeros.
  std::erase_if(result.maps, [&](const MapRow& map) { return !maps.contains(map.record.key); });
  std::erase_if(result.planners,
                [&](const PlannerRow& row) { return !planners.contains(planner_key(row)); });
  return result;
}

GroupColumn parse_group_column(const std::string& text) {
  GroupColumn column;
  const std::size_t slash = text.find('/');
  column.field = text.substr(0, slash);
  if (column.field.empty())
    throw OptionError("'" + text + "': a column's name is missing", "group-by");
  if (slash == std::string::npos) return column;
  column.bin_count = number_from<std::size_t>(text.substr(slash + 1)).value_or(0);
  if (column.bin_count < 2 || column.bin_count > 100) {
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
  std::map<std::vector<PlaceAndName>, Trials> by_place;
  for (const TrialOnMap& on_map : trials) {
    std::vector<PlaceAndName> place;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      place.push_back(binnings[i].group_of(*on_map.trial, columns[i].field));
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
    GroupedTrials& group = groups.emplace_back();
    group.trials = std::move(of_place);
    for (const auto& [value, name] : place) group.keys.push_back(name);
  }
  return groups;
}

std::string range_text(double lowest, double highest) {
  // Ratios and metres with three decimals, counts and other large numbers with one.
  const int decimals = std::max(std::abs(lowest), std::abs(highest)) < 10.0 ? 3 : 1;
  return fixed_digits(lowest, decimals) + "–" + fixed_digits(highest, decimals);
}

}  // namespace avoidbench
