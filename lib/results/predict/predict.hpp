#pragma once

#include <set>
#include <string>
#include <vector>

#include "predict/flown_set.hpp"
#include "statistics/failure_rate.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// A planner's failures over the way flown, by the traversability of maps (docs/predict.md), and
/// where it was flown.
struct PlannerModel {
  std::string label;
  FailureRateFit fit;
  std::int64_t trial_count = 0, reached_count = 0;
  std::size_t map_count = 0;
  double least_traversability = 0.0, greatest_traversability = 0.0;
  double shortest_m = 0.0, longest_m = 0.0;
  std::set<std::string> kinds;  ///< of maps
};

/// One a planner. Throws InputError where none of the maps was measured.
std::vector<PlannerModel> planner_models(const FlownSet& set);

/// Missions on one map that nobody has flown.
struct MapQuestion {
  std::string name = {};  ///< for people
  std::string kind = {};  ///< generator; "" where only its numbers are known
  double traversability = 0.0;
  std::vector<double> lengths_m = {};  ///< of the missions' reference paths
};

/// What the question asks beyond what the planner has flown: "" where nothing.
std::string extrapolation(const PlannerModel& model, const MapQuestion& question);

/// Of each planner the success that is to be expected, the interval of the share of missions that
/// succeed, and what is extrapolated.
Section prediction_section(const std::vector<PlannerModel>& models, const MapQuestion& question,
                           double confidence);

/// A map that was predicted without its flights, beside what was flown there.
struct JudgedMap {
  std::string planner, kind;
  std::int64_t reached_count = 0;
  std::vector<double> probabilities;  ///< of success, one a mission
  std::vector<bool> has_reached;
  double plain_rate = 0.0;       ///< the planner's success rate where the model was fitted
  Interval share;                ///< of missions that succeed, as predicted
  bool is_extrapolated = false;  ///< in traversability
};

/// Each planner's maps of one kind, predicted from its flights on all other kinds. Throws
/// InputError where there is one kind alone.
std::vector<JudgedMap> leave_kinds_out(const FlownSet& set, double confidence);

/// The maps of `flown`, predicted from the flights of the planners of the same label in `set`; of
/// real flights the label of the simulated planner counts.
/// Throws InputError where they have no planner in common.
std::vector<JudgedMap> judged_by(const FlownSet& set, const FlownSet& flown, double confidence);

/// How good the predictions were: by planner and kind, all in all, and their calibration.
Section judgement_section(const std::vector<JudgedMap>& maps, const std::string& title,
                          double confidence);

}  // namespace avoidbench
