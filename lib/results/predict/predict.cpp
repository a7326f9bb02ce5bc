#include "predict/predict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string range_of(double lowest, double highest, const char* unit) {
  return significant_digits(lowest, 3) + " to " + significant_digits(highest, 3) + unit;
}

PlannerModel model_of(const FlownSet& set, const FlownPlanner& planner) {
  PlannerModel model{.label = planner.label, .fit = {}, .kinds = {}};
  model.least_traversability = model.shortest_m = kInfinity;
  model.greatest_traversability = model.longest_m = -kInfinity;
  std::vector<ExposedTrial> trials;
  std::set<std::size_t> maps;
  for (const FlownMission& trial : planner.trials) {
    const FlownMap& map = set.maps[trial.map];
    const bool is_usable = !std::isnan(map.traversability) && trial.reference_length_m > 0.0;
    if (!is_usable) continue;
    trials.push_back({.map = trial.map,
                      .x = map.traversability,
                      .exposure = trial.reference_length_m,
                      .has_failed = !trial.has_reached});
    maps.insert(trial.map);
    model.kinds.insert(map.kind);
    model.reached_count += trial.has_reached ? 1 : 0;
    model.least_traversability = std::min(model.least_traversability, map.traversability);
    model.greatest_traversability = std::max(model.greatest_traversability, map.traversability);
    model.shortest_m = std::min(model.shortest_m, trial.reference_length_m);
    model.longest_m = std::max(model.longest_m, trial.reference_length_m);
  }
  model.trial_count = static_cast<std::int64_t>(trials.size());
  model.map_count = maps.size();
  model.fit = fit_failure_rate(trials);
  return model;
}

}  // namespace

std::vector<PlannerModel> planner_models(const FlownSet& set) {
  std::vector<PlannerModel> models;
  for (const FlownPlanner& planner : set.planners) {
    PlannerModel model = model_of(set, planner);
    if (model.trial_count > 0) models.push_back(std::move(model));
  }
  if (models.empty()) throw InputError("no trial was flown on a map whose traversability is known");
  return models;
}

std::string extrapolation(const PlannerModel& model, const MapQuestion& question) {
  std::vector<std::string> beyond;
  if (!question.kind.empty() && !model.kinds.contains(question.kind)) {
    beyond.push_back("kind " + question.kind + " (flown: " + joined(model.kinds) + ")");
  }
  const double asked = question.traversability;
  if (asked < model.least_traversability || asked > model.greatest_traversability) {
    beyond.push_back("traversability (flown: " +
                     range_of(model.least_traversability, model.greatest_traversability, "") + ")");
  }
  const auto [shortest, longest] =
      std::minmax_element(question.lengths_m.begin(), question.lengths_m.end());
  // A failure rate over the way is meant to hold for other ways, but not by any factor.
  if (*shortest < 0.5 * model.shortest_m || *longest > 2.0 * model.longest_m) {
    beyond.push_back("distance (flown: " + range_of(model.shortest_m, model.longest_m, " m") + ")");
  }
  return joined(beyond, "; ");
}

Section prediction_section(const std::vector<PlannerModel>& models, const MapQuestion& question,
                           double confidence) {
  const std::string percent = significant_digits(100.0 * confidence, 3) + " %";
  Table table = make_table(
      "prediction", "Predicted success",
      {planner_column(),
       {.name = "trial_count", .header = "flown", .doc = "trials that it is predicted from"},
       {.name = "map_count", .header = "maps", .doc = "maps on which they were flown"},
       {.name = "success_rate",
        .header = "SR",
        .doc = "success rate of these trials",
        .decimals = 3},
       {.name = "predicted_success_rate",
        .header = "predicted SR",
        .doc = "of missions on a map like this one; the interval is for the share of " +
               counted(question.lengths_m.size(), "mission") + " that would succeed on " + percent +
               " of such maps",
        .decimals = 3,
        .has_interval = true},
       {.name = "failures_per_km",
        .header = "failures",
        .unit = "1/km",
        .doc = "of " + percent + " of such maps: failures per km of reference path",
        .decimals = 1,
        .has_interval = true},
       {.name = "slope",
        .doc = "by how much ln(failures per km) changes with one unit of traversability",
        .decimals = 1,
        .has_interval = true},
       machine_column("extrapolated")});
  std::map<std::string, std::vector<std::string>> beyond_of;  // what, whose
  for (const PlannerModel& model : models) {
    const SuccessPrediction prediction =
        predict_success(model.fit, question.traversability, question.lengths_m, confidence,
                        stream(1, "prediction"));
    const std::string beyond = extrapolation(model, question);
    if (!beyond.empty()) beyond_of[beyond].push_back(model.label);
    const SlopeEstimate slope = failure_slope(model.fit, confidence);
    const Interval& rate = prediction.failures_per_exposure;
    const double plain =
        static_cast<double>(model.reached_count) / static_cast<double>(model.trial_count);
    table.rows.push_back(make_row(
        model.label, model.trial_count, model.map_count, plain, prediction.rate, prediction.share,
        1000.0 * prediction.median_failures_per_exposure, 1000.0 * rate.lower, 1000.0 * rate.upper,
        slope.mean, slope.interval, beyond.empty() ? Cell{} : Cell{.value = beyond}));
  }
  Section section{.name = "prediction"};
  section.title = "Expected success on " + question.name;
  for (const auto& [beyond, labels] : beyond_of) {
    section.warnings.push_back("beyond what was flown by " + joined(labels) + ": " + beyond);
  }
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace avoidbench
