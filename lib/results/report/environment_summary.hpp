#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/planner_summary.hpp"

namespace avoidbench {

/// One map: its measures, its missions' means, and how all planners together fared there.
struct MapSummary {
  std::size_t map = 0;  ///< index into SweepResult::maps
  std::int64_t mission_count = 0, invalid_mission_count = 0, trial_count = 0, finished_count = 0;
  double traversability_obstruction = 0.0, view_occlusion = 0.0, angle_over_length_1pm = 0.0;
};

/// How a measure of maps goes with their traversability, over maps.
struct EnvironmentCorrelation {
  std::string measure;         ///< a column of the table of maps
  std::int64_t map_count = 0;  ///< that have it
  double mean = 0.0, lowest = 0.0, highest = 0.0;
  double pearson = 0.0, spearman = 0.0;          ///< with traversability; NaN where one is constant
  Interval pearson_interval, spearman_interval;  ///< 95 %, Fisher's z
};

struct EnvironmentSummary {
  std::vector<std::string> axes;  ///< what the sweep varies of its maps: "map.poisson_radius_m"
  std::vector<MapSummary> maps;   ///< the least traversable first
  std::vector<EnvironmentCorrelation> correlations;  ///< of those measures that vary
};

/// What the map's spec says of a field of trials that is one of their map, such as
/// "map.poisson_radius_m": a number, a text, or JSON; nothing where it has none.
TableValue map_field(const MapRow& map, std::string_view field);

EnvironmentSummary environment_summary(const SweepResult& result, const Trials& trials);

}  // namespace avoidbench
