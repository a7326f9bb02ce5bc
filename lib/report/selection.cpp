#include "report/selection.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "base/check.hpp"
#include "base/option_error.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

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
  double number = 0.0;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  if (error == std::errc{} && rest == end) return {.word = word, .number = number};
  if (word == "true") return {.word = word, .number = 1.0};
  if (word == "false") return {.word = word, .number = 0.0};
  return {.word = word, .number = std::nullopt};
}

/// The value as a double, in `storage` if it is held as a whole number; null where it is none.
const double* number_in(const TableValue& value, double& storage) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    storage = static_cast<double>(*whole);
    return &storage;
  }
  return std::get_if<double>(&value);
}

/// Numbers by value, whichever way they are held.
/// "3" and "3.0" are one number; words are compared as words, also "007".
bool is_equal(const TableValue& value, const Condition::Value& wanted) {
  if (const auto* words = std::get_if<std::string>(&value)) return *words == wanted.word;
  double storage = 0.0;
  const double* number = number_in(value, storage);
  return number != nullptr && wanted.number && *number == *wanted.number;
}

std::size_t field_of(const SweepResult& result, const Condition& condition) {
  const auto found = std::find(result.fields.begin(), result.fields.end(), condition.field);
  AB_CHECK(found != result.fields.end());
  return static_cast<std::size_t>(found - result.fields.begin());
}

std::string text_of(const TableValue& value) {
  if (const auto* words = std::get_if<std::string>(&value)) return *words;
  double storage = 0.0;
  const double* number = number_in(value, storage);
  return number == nullptr ? "nothing" : shortest(*number);
}

}  // namespace

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
  double storage = 0.0;
  const double* number = number_in(value, storage);
  // Nothing and texts are neither below nor above a number.
  if (number == nullptr) return false;
  const double limit = condition.values.front().number.value();
  switch (condition.comparison) {
    case Comparison::less:
      return *number < limit;
    case Comparison::at_most:
      return *number <= limit;
    case Comparison::greater:
      return *number > limit;
    default:
      return *number >= limit;
  }
}

/// A value that no trial has is likely misspelt. Without this, a condition with `=` would leave
/// nothing and one with `!=` leave out nothing, both in silence.
void check_values(std::span<const SweepResult* const> results,
                  const std::vector<Condition>& conditions) {
  constexpr std::size_t kMostShown = 12;
  for (const Condition& condition : conditions) {
    const bool is_by_value =
        condition.comparison == Comparison::equal || condition.comparison == Comparison::unequal;
    if (!is_by_value) continue;
    std::set<TableValue> there;
    for (const SweepResult* result : results) {
      const std::size_t field = field_of(*result, condition);
      for (const TrialSummary& trial : result->trials) there.insert(trial.fields[field]);
    }
    for (const Condition::Value& value : condition.values) {
      const auto is_meant = [&](const TableValue& one) { return is_equal(one, value); };
      if (std::any_of(there.begin(), there.end(), is_meant)) continue;
      std::vector<std::string> words;
      for (const TableValue& one : there) {
        if (!std::holds_alternative<std::monostate>(one)) words.push_back(text_of(one));
      }
      const std::string near = did_you_mean(value.word, words);
      const std::size_t count = words.size();
      words.resize(std::min(kMostShown, count));
      throw OptionError("'" + condition.text + "': no trial has " + value.word + near +
                            "; there are: " + joined(words) + (count > kMostShown ? ", …" : ""),
                        "where");
    }
  }
}

SweepResult selected(SweepResult result, const std::vector<Condition>& conditions) {
  std::set<std::string> maps, planners;
  for (const Condition& condition : conditions) {
    // Conditions hold together: each takes out what it refuses.
    const std::size_t field = field_of(result, condition);
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

}  // namespace avoidbench
