#include "page/sweep_data.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/json_path.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "page/packed.hpp"
#include "report/sweep_tables.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostReason = 300;  ///< of what a planner or the program says, characters

/// JSON has neither NaN nor infinity; an interval's open end says which.
ordered_json number(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

ordered_json value_json(const TableValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* seed = std::get_if<std::uint64_t>(&value)) {
    return *seed < (1ULL << 53U) ? ordered_json(*seed) : ordered_json(std::to_string(*seed));
  }
  if (const auto* real = std::get_if<double>(&value)) return number(*real);
  return nullptr;
}

constexpr std::string_view kPlaceTexts[] = {"key", "value", "bound", "words", "machine"};

ordered_json planners_json(const PageSweep& sweep, const PagePlanners& planners) {
  constexpr std::string_view kParameter = "planner.";
  const std::string& varied = sweep.summary.limits.rule.field;
  ordered_json all = ordered_json::array();
  for (std::size_t i = 0; i < planners.labels.size(); ++i) {
    const PlannerRow& planner = sweep.result.planners[planners.rows[i]];
    // Text from the database stays text; parameters are JSON there.
    ordered_json parameters = ordered_json::parse(planner.parameters_json, nullptr, false);
    if (parameters.is_discarded()) parameters = nullptr;
    if (parameters.is_object() && varied.starts_with(kParameter)) {
      parameters.erase(varied.substr(kParameter.size()));
    }
    all.push_back({{"label", planners.labels[i]},
                   {"name", planner.name},
                   {"version", planner.version},
                   {"digest", planner.file_digest},
                   {"parameters", parameters},
                   {"is_privileged", planner.is_privileged}});
  }
  return all;
}

ordered_json maps_json(const PageSweep& sweep) {
  ordered_json all = ordered_json::array();
  for (const MapRow& map : sweep.result.maps) {
    all.push_back({{"text", map_text(map, sweep.summary.environment.axes)},
                   {"traversability", number(map.record.traversability_normalized_ratio)},
                   {"digest", map.record.world_digest}});
  }
  return all;
}

ordered_json metrics_json(const SweepResult& result) {
  ordered_json all = ordered_json::array();
  for (const MetricRow& metric : result.metrics) {
    all.push_back({{"name", metric.name},
                   {"unit", metric.unit},
                   {"doc", metric.doc},
                   {"formula", metric.formula},
                   {"better", text(metric.better)},
                   {"population", text(metric.population)},
                   {"is_measured", metric.is_measured}});
  }
  return all;
}

ordered_json runs_json(const std::vector<RunRow>& runs) {
  ordered_json all = ordered_json::array();
  // Not the host: a page may be handed on.
  for (const RunRow& run : runs) {
    all.push_back({{"date", run.started_at},
                   {"program", run.program_version},
                   {"git", run.git_hash},
                   {"compiler", run.compiler},
                   {"command", run.command_line}});
  }
  return all;
}

/// Words of a column, each once, and of each trial the index of its own.
class Dictionary {
 public:
  void add(const ordered_json& value) {
    const auto [entry, is_new] =
        index_of_.emplace(value.dump(-1, ' ', false, kReplace), words_.size());
    if (is_new) words_.push_back(value);
    indices_.push_back(static_cast<std::int64_t>(entry->second));
  }
  ordered_json json() const { return {{"words", words_}, {"index", packed_deltas(indices_)}}; }

 private:
  static constexpr auto kReplace = ordered_json::error_handler_t::replace;
  std::map<std::string, std::size_t> index_of_;
  ordered_json words_ = ordered_json::array();
  std::vector<std::int64_t> indices_;
};

/// The first six bytes of each key: enough for `replay` to find it by.
std::string packed_keys(const std::vector<TrialSummary>& trials) {
  constexpr std::size_t kDigits = 12;
  Packed packed;
  for (const TrialSummary& trial : trials) {
    const std::string digits = (trial.key + std::string(kDigits, '0')).substr(0, kDigits);
    for (std::size_t i = 0; i < kDigits; i += 2) {
      packed.add_bytes(std::vector<std::uint8_t>{
          static_cast<std::uint8_t>(std::strtoul(digits.substr(i, 2).c_str(), nullptr, 16))});
    }
  }
  return packed.text();
}

ordered_json axes_json(const PageSweep& sweep) {
  ordered_json axes = ordered_json::array();
  for (const std::string& axis : sweep.axes) {
    const auto at = place_in(sweep.result.fields, axis);
    if (!at) continue;
    Dictionary values;
    for (const TrialSummary& trial : sweep.result.trials) values.add(value_json(trial.fields[*at]));
    ordered_json json = values.json();
    json["field"] = axis;
    axes.push_back(std::move(json));
  }
  return axes;
}

ordered_json trials_json(const PageSweep& sweep, const PagePlanners& planners) {
  const std::vector<TrialSummary>& trials = sweep.result.trials;
  std::vector<std::int64_t> ids, missions, outcomes;
  std::vector<double> ends;
  Dictionary reasons, causes;
  for (const TrialSummary& trial : trials) {
    const auto listed = sweep.listing_of.find(trial.key);
    const bool is_listed = listed != sweep.listing_of.end();
    ids.push_back(is_listed ? listed->second.id : 0);
    // A planner may say megabytes; all of it is in the database.
    reasons.add(is_listed ? cut_to_width(listed->second.reason, kMostReason) : "");
    const auto cause = sweep.cause_of.find(trial.key);
    causes.add(cause == sweep.cause_of.end() ? "" : cause->second);
    missions.push_back(trial.mission_index);
    outcomes.push_back(static_cast<std::int64_t>(trial.outcome));
    ends.push_back(trial.end_time_s);
  }
  ordered_json metrics = ordered_json::array();
  for (std::size_t i = 0; i < sweep.result.metrics.size(); ++i) {
    std::vector<double> values;
    for (const TrialSummary& trial : trials) values.push_back(trial.metrics[i]);
    metrics.push_back(packed_floats(values));
  }
  ordered_json json = {{"count", trials.size()},
                       {"planner", packed_deltas(planners.of_trials)},
                       {"map", packed_deltas(maps_of(sweep.result))},
                       {"mission", packed_deltas(missions)},
                       {"outcome", packed_deltas(outcomes)},
                       {"id", packed_deltas(ids)},
                       {"key", packed_keys(trials)},
                       {"end_s", packed_floats(ends)},
                       {"reason", reasons.json()},
                       {"metrics", metrics},
                       {"axes", axes_json(sweep)}};
  if (!sweep.cause_of.empty()) json["cause"] = causes.json();
  return json;
}

ordered_json curves_json(const SweepSummary& summary) {
  ordered_json curves = ordered_json::array();
  // Where a limit is looked for they are of planners at one value each.
  if (summary.limits.rule.is_set()) return curves;
  for (const DifficultyResponse& one : summary.difficulty) {
    curves.push_back({{"planner", one.planner},
                      {"intercept", number(one.intercept)},
                      {"slope", number(one.slope)}});
  }
  return curves;
}

/// What the page needs to draw the tables of limits.
ordered_json limit_json(const LimitRule& rule) {
  if (!rule.is_set()) return nullptr;
  return {{"field", rule.field},
          {"unit", rule.unit},
          {"low", rule.values.front()},
          {"high", rule.values.back()},
          {"success_rate", rule.success_rate}};
}

template <class KeyOfRow, class Rows>
std::map<std::string, std::size_t> index_by_key(const Rows& rows, const KeyOfRow& key_of) {
  std::map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < rows.size(); ++i) index.emplace(key_of(rows[i]), i);
  return index;
}

}  // namespace

ordered_json table_json(const Table& table) {
  ordered_json columns = ordered_json::array(), rows = ordered_json::array();
  for (const Column& column : table.columns) {
    columns.push_back({{"name", column.name},
                       {"header", shown_header(column)},
                       {"unit", column.unit},
                       {"doc", column.doc},
                       {"place", kPlaceTexts[static_cast<std::size_t>(column.place)]},
                       {"decimals", column.decimals}});
  }
  for (const Row& cells : table.rows) {
    ordered_json row = ordered_json::array(), best = ordered_json::array();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      row.push_back(value_json(cells[i].value));
      if (cells[i].is_best) best.push_back(i);
    }
    rows.push_back({{"cells", row}, {"best", best}});
  }
  return {{"name", table.name}, {"title", table.title}, {"columns", columns}, {"rows", rows}};
}

PagePlanners page_planners(const PageSweep& sweep) {
  const LimitRule& rule = sweep.summary.limits.rule;
  const std::vector<PlannerRow>& rows = sweep.result.planners;
  PagePlanners planners;
  std::map<std::string, std::size_t> index_of_label;
  std::vector<std::size_t> of_rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string label =
        rule.is_set() ? label_without(rows[i].label, rule) : sweep.summary.planners[i];
    const auto [entry, is_new] = index_of_label.emplace(label, planners.labels.size());
    if (is_new) {
      planners.labels.push_back(label);
      planners.rows.push_back(i);
    }
    of_rows.push_back(entry->second);
  }
  const auto row_of = index_by_key(rows, [](const auto& row) { return planner_key(row); });
  for (const TrialSummary& trial : sweep.result.trials) {
    planners.of_trials.push_back(of_rows[row_of.at(trial.planner_key)]);
  }
  return planners;
}

std::vector<std::size_t> maps_of(const SweepResult& result) {
  const auto index = index_by_key(result.maps, [](const auto& row) { return row.record.key; });
  std::vector<std::size_t> all;
  for (const TrialSummary& trial : result.trials) all.push_back(index.at(trial.map_key));
  return all;
}

std::string map_text(const MapRow& map, const std::vector<std::string>& axes) {
  std::string words = map.generator + ", seed " + std::to_string(map.map_seed);
  for (const std::string& axis : axes) {
    const TableValue value = map_field(map, axis);
    const auto* number = std::get_if<double>(&value);
    const std::string text = number != nullptr ? significant_digits(*number, 4) : text_of(value);
    if (!text.empty()) words += ", " + short_name(axis, axes) + " " + text;
  }
  return words;
}

ordered_json sweep_json(const PageSweep& sweep) {
  ordered_json tables = ordered_json::array(), outcomes = ordered_json::array();
  for (const Table& table : sweep.section.tables) {
    if (!is_left_out(table)) tables.push_back(table_json(table));
  }
  for (const auto& [outcome, word] : EnumText<Outcome>::entries) outcomes.push_back(word);
  const PagePlanners planners = page_planners(sweep);
  ordered_json usual = ordered_json::array();
  for (const MetricRow& metric : sweep.summary.metrics) usual.push_back(metric.name);
  return {{"name", sweep.summary.name},
          {"revision", sweep.summary.revision},
          {"title", sweep.section.title},
          {"warnings", sweep.summary.warnings},
          {"conditions", sweep.summary.conditions},
          {"tables", tables},
          {"limit", limit_json(sweep.summary.limits.rule)},
          {"curves", curves_json(sweep.summary)},
          {"planners", planners_json(sweep, planners)},
          {"maps", maps_json(sweep)},
          {"metrics", metrics_json(sweep.result)},
          {"usual_metrics", usual},
          {"outcomes", outcomes},
          {"runs", runs_json(sweep.runs)},
          {"trials", trials_json(sweep, planners)}};
}

}  // namespace avoidbench
