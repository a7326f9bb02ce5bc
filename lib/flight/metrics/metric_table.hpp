#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/enum_text.hpp"
#include "metrics/map_record.hpp"
#include "metrics/mover_difficulty.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

enum class Better { less, more, neither };
template <>
struct EnumText<Better> {
  static constexpr std::pair<Better, std::string_view> entries[] = {
      {Better::less, "less"}, {Better::more, "more"}, {Better::neither, "neither"}};
};

/// Which trials a metric speaks of; it is NaN (NULL in the database) for the others.
enum class Population { all, finished };
template <>
struct EnumText<Population> {
  static constexpr std::pair<Population, std::string_view> entries[] = {
      {Population::all, "all"}, {Population::finished, "finished"}};
};

/// What a metric is computed from.
struct MetricInput {
  const TrialSpec& spec;
  const MissionRecord& mission;
  const TrialRecord& record;
  MoverDifficulty movers = {};
};

/// One metric a trial: one row of the table, one column of the database, one header of a CSV file.
struct MetricDef {
  std::string_view name;  ///< with its unit: path_optimality_pct
  int version;            ///< of the definition; values of different versions are never compared
  std::string_view unit;
  std::string_view doc;  ///< one line
  std::string_view formula;
  std::string_view source;
  Better better;
  Population population;
  /// Taken from the host's clock: differs from run to run, left out of exact comparisons.
  bool is_measured;
  double (*compute)(const MetricInput&);
};

/// Every metric, in the order of the database's columns and of reports.
std::span<const MetricDef> metric_table();

/// One value per row of metric_table(), NaN where the trial is not in the metric's population or it
/// isn't defined.
std::vector<double> compute_metrics(const MetricInput& input);

/// A metric of a map, for `avoidbench metrics`: the values are columns of the table `maps`.
struct MapMetricDef {
  std::string_view name, unit, doc, formula, source;
  double (*value)(const MapRecord&);
};
std::span<const MapMetricDef> map_metric_table();

/// A metric of a mission, the same way: columns of the table `missions`.
struct MissionMetricDef {
  std::string_view name, unit, doc, formula, source;
  double (*value)(const MissionRecord&);
};
std::span<const MissionMetricDef> mission_metric_table();

}  // namespace avoidbench
