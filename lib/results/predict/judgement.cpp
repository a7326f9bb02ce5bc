#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "predict/predict.hpp"
#include "report/table_rows.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

/// The model's predictions for the maps of `flown` that are of one of `kinds`.
std::vector<JudgedMap> judged_maps(const PlannerModel& model, const FlownSet& set,
                                   const FlownPlanner& flown, const std::set<std::string>& kinds,
                                   double confidence) {
  std::map<std::size_t, std::vector<const FlownMission*>> by_map;
  for (const FlownMission& trial : flown.trials) {
    const FlownMap& map = set.maps[trial.map];
    if (kinds.contains(map.kind) && !std::isnan(map.traversability)) {
      by_map[trial.map].push_back(&trial);
    }
  }
  std::vector<JudgedMap> judged;
  for (const auto& [number, trials] : by_map) {
    const FlownMap& map = set.maps[number];
    JudgedMap& row = judged.emplace_back();
    row.planner = model.label;
    row.kind = map.kind;
    std::vector<double> lengths_m;
    for (const FlownMission* trial : trials) {
      lengths_m.push_back(trial->reference_length_m);
      row.has_reached.push_back(trial->has_reached);
      row.reached_count += trial->has_reached ? 1 : 0;
    }
    SuccessPrediction prediction = predict_success(model.fit, map.traversability, lengths_m,
                                                   confidence, stream(number, "judgement"));
    row.probabilities = std::move(prediction.probabilities);
    row.share = prediction.share;
    row.plain_rate =
        static_cast<double>(model.reached_count) / static_cast<double>(model.trial_count);
    row.is_extrapolated = map.traversability < model.least_traversability ||
                          map.traversability > model.greatest_traversability;
  }
  return judged;
}

std::set<std::string> kinds_of(const FlownSet& set) {
  std::set<std::string> kinds;
  for (const FlownMap& map : set.maps) {
    if (!std::isnan(map.traversability)) kinds.insert(map.kind);
  }
  return kinds;
}

/// What is told of several judged maps.
struct Judgement {
  std::int64_t map_count = 0, mission_count = 0, reached_count = 0, within_count = 0;
  std::int64_t extrapolated_count = 0;
  double predicted = 0.0, squares = 0.0, plain_squares = 0.0;  ///< sums over missions

  void add(const JudgedMap& map) {
    ++map_count;
    const auto missions = static_cast<double>(map.probabilities.size());
    const double share = static_cast<double>(map.reached_count) / missions;
    // Shares are fractions of the same missions: equal ones differ by rounding alone.
    constexpr double kRounding = 1e-9;
    const bool is_within =
        share >= map.share.lower - kRounding && share <= map.share.upper + kRounding;
    within_count += is_within ? 1 : 0;
    extrapolated_count += map.is_extrapolated ? 1 : 0;
    reached_count += map.reached_count;
    for (std::size_t i = 0; i < map.probabilities.size(); ++i) {
      ++mission_count;
      const double outcome = map.has_reached[i] ? 1.0 : 0.0;
      predicted += map.probabilities[i];
      squares += (map.probabilities[i] - outcome) * (map.probabilities[i] - outcome);
      plain_squares += (map.plain_rate - outcome) * (map.plain_rate - outcome);
    }
  }

  Row row() const {
    const auto missions = static_cast<double>(mission_count);
    return make_row(
        map_count, mission_count, predicted / missions,
        static_cast<double>(reached_count) / missions, squares / missions, plain_squares / missions,
        static_cast<double>(within_count) / static_cast<double>(map_count), extrapolated_count);
  }
};

std::vector<Column> judgement_columns(std::vector<Column> keys, const std::string& percent) {
  const std::vector<Column> columns{
      {.name = "map_count", .header = "maps"},
      {.name = "mission_count", .header = "missions"},
      {.name = "predicted_success_rate",
       .header = "predicted",
       .doc = "success rate",
       .decimals = 3},
      {.name = "success_rate", .header = "flown", .doc = "success rate", .decimals = 3},
      {.name = "brier",
       .header = "Brier",
       .doc = "mean square of predicted probability less outcome, 0 to 1: smaller is better",
       .decimals = 3},
      {.name = "plain_brier",
       .header = "plain",
       .doc = "the same for a prediction that gives each map the planner's success rate elsewhere",
       .decimals = 3},
      {.name = "within_interval",
       .header = "within",
       .doc = "share of maps whose flown share of successes lies in the " + percent + " interval",
       .decimals = 2},
      {.name = "extrapolated_count",
       .header = "beyond",
       .doc = "maps whose traversability is outside of what the prediction was fitted to"}};
  keys.insert(keys.end(), columns.begin(), columns.end());
  return keys;
}

Table calibration_table(const std::vector<JudgedMap>& maps) {
  Table table = make_table(
      "calibration", "Calibration, all planners",
      {{.name = "predicted", .doc = "probability of success as predicted", .place = Place::key},
       {.name = "mission_count", .header = "missions"},
       {.name = "mean_predicted", .header = "mean", .decimals = 3},
       {.name = "success_rate",
        .header = "flown",
        .doc = "success rate; the interval is Wilson's, 95 %, as if missions were independent",
        .decimals = 3,
        .has_interval = true}});
  constexpr std::array<double, 8> kEdges{0.0, 0.25, 0.5, 0.75, 0.9, 0.95, 0.98, 1.0};
  for (std::size_t bin = 0; bin + 1 < kEdges.size(); ++bin) {
    std::int64_t missions = 0, reached = 0;
    double sum = 0.0;
    for (const JudgedMap& map : maps) {
      for (std::size_t i = 0; i < map.probabilities.size(); ++i) {
        const double predicted = map.probabilities[i];
        const bool is_last = bin + 2 == kEdges.size();
        if (predicted < kEdges[bin] || (predicted >= kEdges[bin + 1] && !is_last)) continue;
        ++missions;
        sum += predicted;
        reached += map.has_reached[i] ? 1 : 0;
      }
    }
    if (missions == 0) continue;
    const auto count = static_cast<double>(missions);
    table.rows.push_back(make_row(shortest(kEdges[bin]) + "–" + shortest(kEdges[bin + 1]), missions,
                                  sum / count, static_cast<double>(reached) / count,
                                  wilson_interval(reached, missions)));
  }
  return table;
}

}  // namespace

std::vector<JudgedMap> leave_kinds_out(const FlownSet& set, double confidence) {
  const std::set<std::string> kinds = kinds_of(set);
  if (kinds.size() < 2) {
    throw InputError("maps of only one kind (" + joined(kinds) +
                     "): there is no other to predict it from");
  }
  std::vector<JudgedMap> judged;
  for (const std::string& kind : kinds) {
    FlownSet others = set;
    for (FlownPlanner& planner : others.planners) {
      std::erase_if(planner.trials,
                    [&](const FlownMission& trial) { return set.maps[trial.map].kind == kind; });
    }
    for (const PlannerModel& model : planner_models(others)) {
      const auto flown =
          std::find_if(set.planners.begin(), set.planners.end(),
                       [&](const FlownPlanner& planner) { return planner.label == model.label; });
      const auto maps = judged_maps(model, set, *flown, {kind}, confidence);
      judged.insert(judged.end(), maps.begin(), maps.end());
    }
  }
  return judged;
}

std::vector<JudgedMap> judged_by(const FlownSet& set, const FlownSet& flown, double confidence) {
  std::vector<JudgedMap> judged;
  for (const PlannerModel& model : planner_models(set)) {
    for (const FlownPlanner& planner : flown.planners) {
      const bool is_same =
          planner.label == model.label || planner.label == model.label + std::string(kRealLabel);
      if (!is_same) continue;
      const auto maps = judged_maps(model, flown, planner, kinds_of(flown), confidence);
      judged.insert(judged.end(), maps.begin(), maps.end());
    }
  }
  if (judged.empty()) {
    std::vector<std::string> there, asked;
    for (const FlownPlanner& planner : set.planners) there.push_back(planner.label);
    for (const FlownPlanner& planner : flown.planners) asked.push_back(planner.label);
    throw InputError("no planner of these flights (" + joined(asked) +
                     ") was flown before: " + joined(there));
  }
  return judged;
}

Section judgement_section(const std::vector<JudgedMap>& maps, const std::string& title,
                          double confidence) {
  const std::string percent = significant_digits(100.0 * confidence, 3) + " %";
  std::map<std::string, std::map<std::string, Judgement>> by_kind;
  std::map<std::string, Judgement> by_planner;
  Judgement all;
  for (const JudgedMap& map : maps) {
    by_kind[map.kind][map.planner].add(map);
    by_planner[map.planner].add(map);
    all.add(map);
  }
  Table planners =
      make_table("judged_planners", "By planner", judgement_columns({planner_column()}, percent));
  for (const auto& [planner, judgement] : by_planner) {
    planners.rows.push_back(make_row(planner, judgement.row()));
  }
  if (by_planner.size() > 1) planners.rows.push_back(make_row("all", all.row()));
  Table kinds = make_table(
      "judged_kinds", "By kind of map",
      judgement_columns({{.name = "kind", .place = Place::key}, planner_column()}, percent));
  for (const auto& [kind, judgements] : by_kind) {
    for (const auto& [planner, judgement] : judgements) {
      kinds.rows.push_back(make_row(kind, planner, judgement.row()));
    }
  }
  Section section{.name = "judgement"};
  section.title = title;
  section.tables = {std::move(planners), std::move(kinds), calibration_table(maps)};
  return section;
}

}  // namespace avoidbench
