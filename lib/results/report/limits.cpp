#include "report/limits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "report/table_rows.hpp"
#include "statistics/rates.hpp"
#include "store/stored_text.hpp"

namespace avoidbench {
namespace {

using Cells = std::map<std::pair<std::size_t, std::size_t>, LimitCell>;  // by level and map

std::vector<LimitCell> cells_of(const Cells& cells) {
  std::vector<LimitCell> all;
  for (const auto& [place, cell] : cells) all.push_back(cell);
  return all;
}

/// Numbers of the maps by key: those that differ in the field alone have one. In the order of their
/// specs, as the search has them.
std::map<std::string, std::size_t> map_numbers(const SweepResult& result, const LimitRule& rule) {
  std::map<std::string, std::string> place_of;
  std::map<std::string, std::size_t> places;
  for (const MapRow& map : result.maps) {
    const std::string place = map_place(stored_object(map.spec_json), map.map_seed, rule);
    place_of[map.record.key] = place;
    places.emplace(place, 0);
  }
  std::size_t number = 0;
  for (auto& [place, index] : places) index = number++;
  std::map<std::string, std::size_t> numbers;
  for (const auto& [key, place] : place_of) numbers[key] = places.at(place);
  return numbers;
}

/// "ego" and its like, by key of the planner's row.
std::map<std::string, std::string> labels_by_key(const SweepResult& result, const LimitRule& rule) {
  std::map<std::string, std::string> labels;
  for (const PlannerRow& planner : result.planners) {
    labels[planner_key(planner)] = label_without(planner.label, rule);
  }
  return labels;
}

std::string_view state_text(const LimitEstimate& estimate, const LimitRule& rule) {
  switch (estimate.state) {
    case LimitState::all_above:
      return "above the rate in the whole range";
    case LimitState::all_below:
      return "below the rate in the whole range";
    case LimitState::not_monotone:
      return rule.direction == LimitDirection::falls   ? "success does not fall: no limit"
             : rule.direction == LimitDirection::rises ? "success does not rise: no limit"
                                                       : "success does not go one way: no limit";
    case LimitState::found:
      break;
  }
  const bool is_open = estimate.interval.lower < 0.0 && estimate.interval.upper > 1.0;
  if (is_open) return "more trials needed";
  if (estimate.interval.lower < 0.0) return "near the beginning of the range, or below it";
  if (estimate.interval.upper > 1.0) return "near the end of the range, or beyond it";
  if (estimate.width() > rule.relative_width()) return "more trials needed";
  return estimate.is_falling ? "success falls" : "success rises";
}

/// The limit where there is one.
double value_of(const LimitEstimate& estimate, const LimitRule& rule) {
  const bool is_open = estimate.interval.lower < 0.0 && estimate.interval.upper > 1.0;
  if (estimate.state != LimitState::found || is_open) return math::kNaN;
  // Outside the range the curve is a guess.
  if (estimate.position < 0.0) return -std::numeric_limits<double>::infinity();
  if (estimate.position > 1.0) return std::numeric_limits<double>::infinity();
  return rule.value_at(estimate.position);
}

Interval interval_of(const LimitEstimate& estimate, const LimitRule& rule) {
  if (estimate.state != LimitState::found) return {math::kNaN, math::kNaN};
  return {rule.value_at(estimate.interval.lower), rule.value_at(estimate.interval.upper)};
}

/// NaN where the results have no such metric.
double mean_speed_mps(const SweepResult& result, const TrialSummary& trial) {
  for (std::size_t i = 0; i < result.metrics.size(); ++i) {
    if (result.metrics[i].name == "mean_speed_mps") return trial.metrics[i];
  }
  return math::kNaN;
}

std::string percent(double rate) { return significant_digits(100.0 * rate, 3) + " %"; }

}  // namespace

LimitSummary limits_of(const SweepResult& result, const LimitRule& rule) {
  const auto field = place_in(result.fields, rule.field);
  if (!field) throw InputError("the trials were read without " + rule.field);
  const std::map<std::string, std::size_t> numbers = map_numbers(result, rule);
  const std::map<std::string, std::string> labels = labels_by_key(result, rule);
  std::map<std::string, std::string> versions;
  for (const PlannerRow& planner : result.planners) {
    versions.emplace(label_without(planner.label, rule), planner.version);
  }
  std::map<std::string, Cells> planners;
  std::map<std::string, std::vector<double>> flown_mps;
  for (const TrialSummary& trial : result.trials) {
    const std::optional<double> value = number_in(trial.fields[*field]);
    const std::optional<std::size_t> level = value ? level_of(rule, *value) : std::nullopt;
    if (!level)
      throw InputError("trial " + trial.key + ": its " + rule.field + " is not one of the limit's");
    const std::size_t map = numbers.at(trial.map_key);
    const std::string& label = labels.at(trial.planner_key);
    LimitCell& cell = planners[label][{*level, map}];
    cell.level = *level;
    cell.map = map;
    ++cell.trials;
    flown_mps[label].resize(rule.values.size());
    flown_mps[label][*level] += mean_speed_mps(result, trial);
    if (rule.is_success(trial.outcome, goal_velocity_mps(trial))) ++cell.successes;
  }
  LimitSummary summary;
  summary.rule = rule;
  for (const auto& [key, number] : numbers) {
    summary.map_count = std::max(summary.map_count, static_cast<std::int64_t>(number) + 1);
  }
  const LimitCurve curve = rule.curve();
  const auto map_count = static_cast<std::size_t>(summary.map_count);
  std::vector<std::vector<LimitCell>> cells_by_planner;
  for (const auto& [label, cells] : planners) cells_by_planner.push_back(cells_of(cells));
  const std::vector<double> others = directions_of_others(curve, cells_by_planner);
  std::vector<std::vector<double>> draws;
  for (const auto& [label, cells] : planners) {
    const std::size_t index = summary.planners.size();
    const std::vector<LimitCell>& all = cells_by_planner[index];
    PlannerLimit& planner = summary.planners.emplace_back(
        PlannerLimit{.planner = label,
                     .version = versions.at(label),
                     .estimate = curve.estimate_whole(all, others[index]),
                     .trials = {},
                     .successes = {},
                     .flown_mps = flown_mps.at(label)});
    planner.trials.resize(rule.values.size());
    planner.successes.resize(rule.values.size());
    for (const LimitCell& cell : all) {
      planner.trials[cell.level] += cell.trials;
      planner.successes[cell.level] += cell.successes;
    }
    if (map_count < kLeastMaps || planners.size() < 2) continue;
    // One seed: the same maps are drawn for all planners.
    draws.push_back(limit_draws(curve, all, map_count, map_count, others[index]));
  }
  for (std::size_t one = 0; one < draws.size(); ++one) {
    for (std::size_t two = one + 1; two < draws.size(); ++two) {
      summary.pairs.push_back({one, two, limit_contrast(draws[one], draws[two])});
    }
  }
  return summary;
}

Table limit_speed_table(const LimitSummary& summary) {
  constexpr std::size_t kGroups = 3;
  Table table = make_table(
      "limit_speeds",
      "Speeds flown at these settings: the limit is one of the setting, not of the flown speed",
      {planner_column(),
       {.name = "settings", .header = "setting", .unit = "m/s", .place = Place::key},
       {.name = "trial_count", .header = "trials"},
       {.name = "flown_speed_mps",
        .header = "flown",
        .unit = "m/s",
        .doc = "flown_speed_mps: mean of the flights' mean speeds",
        .brief = "mean of the flights' mean speeds"}});
  if (summary.rule.field != std::string(kOfPlanner) + "max_speed_mps") return table;
  const std::vector<double>& values = summary.rule.values;
  for (const PlannerLimit& planner : summary.planners) {
    for (std::size_t group = 0; group < kGroups; ++group) {
      const std::size_t begin = group * values.size() / kGroups;
      const std::size_t end = (group + 1) * values.size() / kGroups;
      std::int64_t trials = 0;
      double sum_mps = 0.0;
      for (std::size_t level = begin; level < end; ++level) {
        trials += planner.trials[level];
        sum_mps += planner.flown_mps[level];
      }
      if (trials == 0) continue;
      table.rows.push_back(make_row(
          planner.planner,
          significant_digits(values[begin], 3) + "–" + significant_digits(values[end - 1], 3),
          trials, sum_mps / static_cast<double>(trials)));
    }
  }
  return table;
}

Table limit_table(const LimitSummary& summary) {
  const LimitRule& rule = summary.rule;
  const std::string name = rule.field.substr(rule.field.find('.') + 1);
  const std::string what =
      " of missions reach the goal" +
      (rule.reach_mps > 0.0 ? " at " + shortest(rule.reach_mps) + " m/s or faster" : "");
  Table table = make_table(
      "limits", "Limits: " + name + " at which " + percent(rule.success_rate) + what,
      {planner_column(),
       {.name = "limit",
        .unit = rule.unit,
        .doc = "limit: median of the posterior, with its 95 % interval; inf: beyond the range",
        .has_interval = true,
        .brief = "where success crosses the rate [95 % interval]"},
       {.name = "trial_count", .header = "trials"},
       {.name = "state",
        .doc = "state: whether success falls or rises with the field; more trials needed: the "
               "interval is wider than requested"},
       {.name = "first_rate",
        .header = "SR at " + shortest(rule.values.empty() ? 0.0 : rule.values.front()),
        .doc = "rates of the fitted curve at both ends of the range, with 95 % intervals",
        .has_interval = true},
       {.name = "last_rate",
        .header = "SR at " + shortest(rule.values.empty() ? 0.0 : rule.values.back()),
        .has_interval = true},
       {.name = "map_inflation",
        .header = "maps ×",
        .doc = "map_inflation: how much more maps scatter about the curve than independent trials "
               "would; the likelihood is divided by it"},
       {.name = "monotone_p",
        .header = "p mono",
        .doc = "monotone_p: of rates that go one way as badly as these; below 0.02 there is no "
               "limit",
        .decimals = 3},
       {.name = "field", .doc = "what was varied"},
       {.name = "wanted_rate", .doc = "wanted_rate: the success rate at the limit"}});
  for (Column& column : table.columns) {
    // Read by those who ask for all of it.
    for (const char* unseen : {"map_inflation", "monotone_p", "field", "wanted_rate"}) {
      if (column.name == unseen) column.place = Place::machine;
    }
  }
  for (const PlannerLimit& planner : summary.planners) {
    const LimitEstimate& e = planner.estimate;
    table.rows.push_back(make_row(planner.planner, value_of(e, rule), interval_of(e, rule),
                                  e.trials, state_text(e, rule), e.rates.front(),
                                  e.rate_intervals.front(), e.rates.back(), e.rate_intervals.back(),
                                  e.map_inflation, e.monotone_p, rule.field, rule.success_rate));
  }
  return table;
}

Table limit_pair_table(const LimitSummary& summary) {
  Table table = make_table(
      "limit_pairs", "Pairs of planners: which has the higher limit",
      {planner_column(),
       {.name = "other_planner", .header = "against", .place = Place::key},
       {.name = "limit_difference",
        .header = "difference",
        .unit = summary.rule.unit,
        .doc = "limit_difference: of the two limits, median and 95 % interval over draws of maps "
               "(bootstrap), the same maps for both; beyond the range counts as its end",
        .has_interval = true,
        .brief = "of the limits [95 % interval]"},
       {.name = "higher_share_pct",
        .header = "higher",
        .unit = "%",
        .doc = "share of the draws in which the first planner has the higher limit",
        .decimals = 1,
        .brief = "that the first has the higher one"}});
  const double range =
      summary.rule.is_set() ? summary.rule.values.back() - summary.rule.values.front() : 0.0;
  for (const LimitPair& pair : summary.pairs) {
    const LimitContrast& c = pair.contrast;
    table.rows.push_back(make_row(summary.planners[pair.planner_1].planner,
                                  summary.planners[pair.planner_2].planner, range * c.difference,
                                  Interval{range * c.interval.lower, range * c.interval.upper},
                                  100.0 * c.first_is_higher));
  }
  return table;
}

Table limit_curve_table(const LimitSummary& summary) {
  Table table = make_table("limit_curve", "Success along the range",
                           {planner_column(),
                            {.name = "value", .unit = summary.rule.unit, .place = Place::key},
                            {.name = "trial_count", .header = "trials"},
                            {.name = "finished_count", .header = "finished"},
                            {.name = "fitted_rate",
                             .header = "SR fitted",
                             .doc = "fitted_rate: of the fitted curve, with its 95 % interval",
                             .has_interval = true}});
  for (const PlannerLimit& planner : summary.planners) {
    for (std::size_t level = 0; level < summary.rule.values.size(); ++level) {
      table.rows.push_back(make_row(planner.planner, summary.rule.values[level],
                                    planner.trials[level], planner.successes[level],
                                    planner.estimate.rates[level],
                                    planner.estimate.rate_intervals[level]));
    }
  }
  return table;
}

std::vector<std::string> warnings_of(const LimitSummary& summary) {
  std::vector<std::string> warnings;
  if (summary.map_count < static_cast<std::int64_t>(kLeastMaps)) {
    warnings.push_back("on " + std::to_string(summary.map_count) +
                       " maps: fewer than five don't show how maps differ, so the intervals hold "
                       "for these maps only, and pairs are not compared");
  }
  for (const PlannerLimit& planner : summary.planners) {
    const bool is_open = planner.estimate.state == LimitState::found &&
                         planner.estimate.width() > summary.rule.relative_width();
    if (!is_open) continue;
    warnings.push_back("the interval of " + planner.planner +
                       " is wider than requested; more maps, missions or trials would narrow it");
  }
  return warnings;
}

}  // namespace avoidbench
