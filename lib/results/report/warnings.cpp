#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/number_text.hpp"
#include "base/words.hpp"
#include "report/speed_tables.hpp"
#include "report/summary.hpp"
#include "statistics/sample_size.hpp"
#include "statistics/stop_rule.hpp"
#include "store/trial_table.hpp"
#include "sweep/planner_tallies.hpp"
#include "trial/map_fields.hpp"

namespace avoidbench {
namespace {

// With 5 successes of 10 Wilson's 95 % interval still goes from 24 to 76 %.
constexpr std::int64_t kFewTrials = 10;

using Warnings = std::vector<std::string>;

void warn_of_few_trials(const SweepSummary& summary, Warnings& warnings) {
  std::vector<std::string> few;
  for (const PlannerSummary& planner : summary.overall) {
    if (planner.trial_count < kFewTrials) few.push_back(summary.planners[planner.planner]);
  }
  if (!few.empty()) {
    warnings.push_back("fewer than 10 trials of " + joined(few, ", ") +
                       ": too few for a conclusion");
  }
  // Cells of the table that is shown: the groups asked for, or else those by traversability.
  std::int64_t few_cells = 0, cells = 0;
  const auto count = [&](const PlannerSummary& cell) {
    few_cells += cell.trial_count < kFewTrials ? 1 : 0;
    ++cells;
  };
  for (const GroupRow& row : summary.group_rows) count(row.summary);
  if (summary.group_rows.empty()) {
    for (const MapGroup& group : summary.groups) {
      if (group.map_count < 2) continue;  // a map of its own, not a group
      for (const PlannerSummary& planner : group.planners) count(planner);
    }
  }
  if (few_cells > 0) {
    warnings.push_back("fewer than 10 trials in " + std::to_string(few_cells) + " of " +
                       counted(cells, "cell") + " of planner and group");
  }
}

void warn_of_unclear_differences(const SweepSummary& summary, Warnings& warnings) {
  std::vector<std::string> unclear;
  for (const Contrast& contrast : summary.contrasts) {
    if (contrast.is_clear()) continue;
    const PlannerSummary& a = summary.overall[contrast.planner_1];
    const PlannerSummary& b = summary.overall[contrast.planner_2];
    std::string pair =
        summary.planners[contrast.planner_1] + " / " + summary.planners[contrast.planner_2];
    // Equal rates would take endlessly many.
    if (a.success_rate != b.success_rate) {
      // By their own rates: how many would show this difference, if it is one.
      const double trials = std::ceil(two_rates_trials(a.success_rate, b.success_rate));
      pair += " (would take some " + fixed_digits(trials, 0) + " trials each)";
    }
    unclear.push_back(pair);
  }
  constexpr std::size_t kMostNamed = 10;
  if (unclear.size() > kMostNamed) {
    warnings.push_back("success rates that can't be told apart: " + std::to_string(unclear.size()) +
                       " of " + std::to_string(summary.contrasts.size()) +
                       " pairs; the table pairs names them");
  } else if (!unclear.empty()) {
    warnings.push_back("success rates that can't be told apart: " + joined(unclear, ", "));
  }
}

/// How many values the sweep's axes have together: those that make maps, or the others.
std::int64_t axis_product(const nlohmann::json& spec, bool of_maps) {
  std::int64_t product = 1;
  for (const auto& axis : spec.value("axes", nlohmann::json::array())) {
    if (makes_maps(axis.value("path", "")) != of_maps) continue;
    product *= static_cast<std::int64_t>(axis.value("values", nlohmann::json::array()).size());
  }
  return product;
}

/// How often the sweep flies a mission: planners times settings on the same map.
std::int64_t flights_of_mission(const nlohmann::json& spec) {
  const std::size_t planner_count = spec.value("planners", nlohmann::json::array()).size();
  // Axes that make no maps are settings: each flies the same missions again.
  return static_cast<std::int64_t>(planner_count) * axis_product(spec, false);
}

/// Trials that the sweep asks for; 0 where its spec does not say.
std::int64_t asked_trials(const nlohmann::json& spec) {
  const std::int64_t count =
      spec.value("trials", std::int64_t{0}) * flights_of_mission(spec) * axis_product(spec, true);
  // With listed missions maps may have unlike numbers of them.
  return spec.value("trial_count", count);
}

void warn_of_planners(const SweepSummary& summary, const SweepResult& result, Warnings& warnings) {
  PlannerTallies tallies(result.metrics);
  for (const TrialSummary& trial : result.trials) {
    tallies.add(trial.planner_key, trial.outcome, trial.metrics);
  }
  std::vector<std::pair<std::string, std::string>> planners;
  for (std::size_t i = 0; i < result.planners.size(); ++i) {
    planners.emplace_back(planner_key(result.planners[i]), summary.planners[i]);
  }
  for (std::string& warning : tallies.warnings(planners, result.spec_json)) {
    warnings.push_back(std::move(warning));
  }
}

void warn_of_mixtures(const SweepSummary& summary, const SweepResult& result, Warnings& warnings) {
  if (result.program_versions.size() > 1) {
    warnings.push_back("trials of different versions of avoidbench: " +
                       joined(result.program_versions, ", "));
  }
  std::map<std::string, std::string> key_of_label;
  for (const PlannerRow& planner : result.planners) {
    if (!key_of_label.emplace(planner.label, planner_key(planner)).second) {
      warnings.push_back("planners of different files or parameters share the label " +
                         planner.label);
    }
  }
  // The groups were asked for to tell them apart.
  if (!summary.group_rows.empty()) return;
  // Numbers in the keys' place: many keys are slow to sort.
  std::map<std::string_view, std::size_t> numbers;
  const auto number_of = [&](std::string_view key) {
    return numbers.emplace(key, numbers.size()).first->second;
  };
  using Flight = std::tuple<std::size_t, std::size_t, std::int64_t>;
  std::vector<Flight> flights;
  flights.reserve(result.trials.size());
  for (const TrialSummary& trial : result.trials) {
    const std::size_t planner = number_of(trial.planner_key);
    flights.emplace_back(planner, number_of(trial.map_key), trial.mission_index);
  }
  // Two flights of one planner on one mission: they differ in a setting.
  std::sort(flights.begin(), flights.end());
  if (std::adjacent_find(flights.begin(), flights.end()) == flights.end()) return;
  std::vector<std::string> axes = axis_paths(result.spec_json);
  std::erase_if(axes, makes_maps);
  warnings.push_back(
      "trials differ in more than planner, map and mission; this report merges them" +
      (axes.empty() ? "" : "; groups of planner," + joined(axes, ",") + " separate them"));
}

/// Missions a map that the planner's trials reach up to.
std::int64_t mission_count_of(const SweepResult& result, const std::string& label) {
  std::set<std::string> keys;
  for (const PlannerRow& planner : result.planners) {
    if (planner.label == label) keys.insert(planner_key(planner));
  }
  std::int64_t count = 0;
  for (const TrialSummary& trial : result.trials) {
    if (keys.contains(trial.planner_key)) count = std::max(count, trial.mission_index + 1);
  }
  return count;
}

/// Planners that stopped by the sweep's rule. What they left out is not missing.
std::int64_t warn_of_stops(const SweepSummary& summary, const SweepResult& result,
                           const nlohmann::json& spec, std::int64_t asked_a_planner,
                           Warnings& warnings) {
  const std::string text = spec.value("until", "");
  if (text.empty()) return 0;
  const StopRule rule = parse_stop_rule(text);
  std::int64_t left_out = 0;
  for (const PlannerSummary& planner : summary.overall) {
    // It has flown all: the rule had no part in it.
    if (planner.trial_count >= asked_a_planner) continue;
    if (!is_enough(rule, planner.finished_count, planner.trial_count)) continue;
    const std::string& label = result.planners[planner.planner].label;
    left_out += asked_a_planner - planner.trial_count;
    warnings.push_back(summary.planners[planner.planner] + " stopped after " +
                       std::to_string(mission_count_of(result, label)) + " of " +
                       counted(spec.value("trials", std::int64_t{0}), "mission") +
                       " per map, as the sweep's rule says (until " + text + ")");
  }
  return left_out;
}

/// Not of a selection: what was left out on purpose is not missing.
void warn_of_missing_trials(const SweepSummary& summary, const SweepResult& result,
                            const nlohmann::json& spec, Warnings& warnings) {
  const std::int64_t asked = asked_trials(spec);
  const auto planner_count =
      static_cast<std::int64_t>(spec.value("planners", nlohmann::json::array()).size());
  // A spec that asks for trials of no planner is damaged.
  if (asked == 0 || planner_count == 0 || !summary.conditions.empty()) return;
  // An invalid mission is flown by no planner, in none of the settings that share its map.
  const std::int64_t invalid = summary.invalid_mission_count * flights_of_mission(spec);
  const std::int64_t left_out =
      warn_of_stops(summary, result, spec, (asked - invalid) / planner_count, warnings);
  const std::int64_t missing =
      asked - invalid - left_out - static_cast<std::int64_t>(result.trials.size());
  if (missing <= 0) return;
  warnings.push_back("the sweep is not finished: " + std::to_string(missing) + " of its " +
                     std::to_string(asked - invalid) +
                     " trials are not flown yet, and those that are may be the quick or easy ones");
}

}  // namespace

/// The gravest first: what is missing, then what is few, then what is unlike.
std::vector<std::string> warnings_of(const SweepSummary& summary, const SweepResult& result) {
  // An older or foreign spec that can't be read warns of less and throws nothing.
  const nlohmann::json parsed = nlohmann::json::parse(result.spec_json, nullptr, false);
  const nlohmann::json spec = parsed.is_object() ? parsed : nlohmann::json::object();
  Warnings warnings;
  warn_of_missing_trials(summary, result, spec, warnings);
  warn_of_few_trials(summary, warnings);
  for (std::string& warning : speed_warnings(summary)) warnings.push_back(std::move(warning));
  warn_of_unclear_differences(summary, warnings);
  warn_of_planners(summary, result, warnings);
  warn_of_mixtures(summary, result, warnings);
  if (result.has_measured_latency) {
    warnings.push_back(
        "latency was measured on the host: these results depend on the machine; only latency mode "
        "replay repeats them bit for bit");
  }
  return warnings;
}

}  // namespace avoidbench
