#include "what_if/what_if_tables.hpp"

#include <cmath>
#include <map>

#include "base/number_text.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

/// Flights of failures on one map.
struct OnMap {
  std::int64_t flown = 0, cured = 0;
};

/// As reports have it of success rates: Wilson's, from five maps on widened by how much they
/// differ.
Interval interval_over(const std::map<std::string, OnMap>& maps) {
  constexpr std::size_t kEnoughMaps = 5;
  std::vector<std::int64_t> cured, flown;
  std::int64_t all_cured = 0, all_flown = 0;
  for (const auto& [key, on_map] : maps) {
    cured.push_back(on_map.cured);
    flown.push_back(on_map.flown);
    all_cured += on_map.cured;
    all_flown += on_map.flown;
  }
  return maps.size() < kEnoughMaps ? wilson_interval(all_cured, all_flown)
                                   : clustered_wilson_interval(cured, flown);
}

Cell what_if_cell(double value) {
  return {.value = std::isnan(value) ? TableValue() : TableValue(value)};
}
Cell what_if_cell(std::int64_t value) { return {.value = value}; }
Cell what_if_cell(std::string_view value) { return {.value = std::string(value)}; }

double percent(std::int64_t part, std::int64_t all) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(all);  // NaN of none
}

Table counts_table(const std::vector<WhatIfCount>& counts) {
  Table table{
      .name = "what_if",
      .title = "What would have cured it",
      .columns = {
          {.name = "planner", .place = Place::key},
          {.name = "change", .place = Place::key},
          {.name = "failures",
           .header = "failures",
           .doc = "trials that did not reach the goal, flown again with the change"},
          {.name = "cured", .header = "cured", .doc = "of them, those that reach the goal with it"},
          {.name = "cured_pct",
           .header = "share",
           .unit = "%",
           .doc = "cured of failures, with a 95 % interval: Wilson's, from five maps on widened by "
                  "the differences between maps",
           .decimals = 0,
           .has_interval = true},
          {.name = "cured_pct_lower", .unit = "%", .place = Place::bound},
          {.name = "cured_pct_upper", .unit = "%", .place = Place::bound},
          {.name = "maps", .place = Place::machine},
          {.name = "successes",
           .header = "successes",
           .doc = "trials that reached the goal, flown again with the change as a control"},
          {.name = "broken", .header = "broken", .doc = "of them, those that don't with it"},
          {.name = "broken_pct", .unit = "%", .place = Place::machine},
          {.name = "not_applicable",
           .header = "n/a",
           .doc = "failures that it would not change, or to which it does not apply: not flown"},
          {.name = "missing", .header = "missing", .doc = "not flown yet"}}};
  for (const WhatIfCount& count : counts) {
    table.rows.push_back({what_if_cell(count.planner_label), what_if_cell(count.change->name),
                          what_if_cell(count.failures), what_if_cell(count.cured),
                          what_if_cell(percent(count.cured, count.failures)),
                          what_if_cell(100.0 * count.cured_share.lower),
                          what_if_cell(100.0 * count.cured_share.upper), what_if_cell(count.maps),
                          what_if_cell(count.successes), what_if_cell(count.broken),
                          what_if_cell(percent(count.broken, count.successes)),
                          what_if_cell(count.not_applicable), what_if_cell(count.missing)});
  }
  return table;
}

Table sentences_table(const std::vector<WhatIfCount>& counts) {
  Table table{.name = "what_if_sentences",
              .title = "In words",
              .columns = {{.name = "planner", .place = Place::key},
                          {.name = "change", .place = Place::key},
                          {.name = "sentence", .place = Place::words}}};
  for (const WhatIfCount& count : counts) {
    // A flight as it was says nothing of failures, and one that was not flown nothing at all.
    if (count.change->name == kNoChange || count.failures + count.successes == 0) continue;
    table.rows.push_back({what_if_cell(count.planner_label), what_if_cell(count.change->name),
                          what_if_cell(sentence_of(count))});
  }
  return table;
}

/// What became of one trial.
Table trial_table_of(const WhatIfPlan& plan) {
  Table table{.name = "what_if_trial",
              .title = "What would have changed it",
              .columns = {{.name = "change", .place = Place::key},
                          {.name = "outcome", .place = Place::words},
                          {.name = "end_time_s", .header = "end", .unit = "s", .decimals = 3},
                          {.name = "reason", .place = Place::words}}};
  for (const WhatIfTrial& trial : plan.trials) {
    table.rows.push_back({what_if_cell("(as it was)"), what_if_cell(text(trial.outcome)),
                          what_if_cell(trial.end_time_s), what_if_cell(trial.reason)});
  }
  for (const WhatIfFlight& flight : plan.flights) {
    Row row{what_if_cell(flight.change->name)};
    if (flight.row) {
      row.push_back(what_if_cell(text(flight.row->outcome)));
      row.push_back(what_if_cell(flight.row->end_time_s));
      row.push_back(what_if_cell(flight.row->reason));
    } else {
      row.push_back(what_if_cell(flight.not_applicable.empty() ? "not flown yet" : "not flown"));
      row.push_back({});
      row.push_back(what_if_cell(flight.not_applicable));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string capitalised(std::string_view words) {
  std::string result(words);
  if (result[0] >= 'a' && result[0] <= 'z') result[0] = static_cast<char>(result[0] - 'a' + 'A');
  return result;
}

std::string whole_percent(double share) { return fixed_digits(100.0 * share, 0); }

}  // namespace

std::vector<WhatIfCount> count_what_ifs(const WhatIfPlan& plan) {
  // By planner, then by the change's place in the table: flights of a trial are in that order.
  std::map<std::pair<std::string, const Change*>, WhatIfCount> counts;
  std::map<std::pair<std::string, const Change*>, std::map<std::string, OnMap>> maps;
  for (const WhatIfFlight& flight : plan.flights) {
    const WhatIfTrial& trial = plan.trials[flight.trial];
    const std::pair key(trial.planner_label, flight.change);
    WhatIfCount& count = counts[key];
    count.planner_label = trial.planner_label;
    count.change = flight.change;
    count.missing += flight.is_missing() ? 1 : 0;
    if (!flight.not_applicable.empty()) count.not_applicable += trial.is_failure() ? 1 : 0;
    if (!flight.row) continue;
    const bool is_reached = flight.row->outcome == Outcome::reached_goal;
    if (trial.is_failure()) {
      ++count.failures;
      count.cured += is_reached ? 1 : 0;
      OnMap& on_map = maps[key][trial.map_key];
      ++on_map.flown;
      on_map.cured += is_reached ? 1 : 0;
    } else {
      ++count.successes;
      count.broken += is_reached ? 0 : 1;
    }
  }
  std::vector<WhatIfCount> all;
  for (auto& [key, count] : counts) {
    count.maps = static_cast<std::int64_t>(maps[key].size());
    count.cured_share = interval_over(maps[key]);
    all.push_back(std::move(count));
  }
  return all;
}

std::string sentence_of(const WhatIfCount& count) {
  const std::string phrase = capitalised(count.change->phrase);
  const std::string broken = "of " + std::to_string(count.successes) + " success" +
                             (count.successes == 1 ? " " : "es ") +
                             (count.broken == 0 ? "none" : std::to_string(count.broken)) +
                             (count.broken <= 1 ? " breaks" : " break");
  if (count.failures == 0) return phrase + ", " + broken + ".";
  return phrase + " " + std::to_string(count.cured) + " of " + std::to_string(count.failures) +
         " of " + count.planner_label + "'s failures " +
         (count.cured == 1 ? "vanishes" : "vanish") + " (" +
         fixed_digits(percent(count.cured, count.failures), 0) + " %, " +
         whole_percent(count.cured_share.lower) + "–" + whole_percent(count.cured_share.upper) +
         ")" + (count.successes > 0 ? "; " + broken : "") + ".";
}

Section what_if_section(const WhatIfPlan& plan, const WhatIfRequest& request,
                        const std::string& database) {
  Section section{.name = database, .title = "What if, " + database, .warnings = plan.warnings};
  if (request.trial.empty()) {
    const std::vector<WhatIfCount> counts = count_what_ifs(plan);
    section.tables = {counts_table(counts), sentences_table(counts)};
  } else {
    section.tables = {trial_table_of(plan)};
  }
  for (const std::string& line : what_if_differences(plan)) section.warnings.push_back(line);
  return section;
}

std::vector<std::string> what_if_differences(const WhatIfPlan& plan) {
  std::vector<std::string> lines;
  for (const WhatIfFlight& flight : plan.flights) {
    const WhatIfTrial& trial = plan.trials[flight.trial];
    const bool is_compared =
        flight.change->name == kNoChange && flight.row && !trial.record_digest.empty();
    if (!is_compared || flight.row->record_digest == trial.record_digest) continue;
    lines.push_back("trial " + std::to_string(trial.id) + " (" + trial.key.substr(0, 8) + ", " +
                    trial.planner_label +
                    ") differs from what is stored though nothing was "
                    "changed: avoidbench replay shows where");
  }
  return lines;
}

}  // namespace avoidbench
