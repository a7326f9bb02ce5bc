#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "store/rows.hpp"
#include "suite/suite_result.hpp"

namespace avoidbench {

/// A map that was flown, as predictions see it.
struct FlownMap {
  std::string kind;             ///< its generator
  double traversability = 0.0;  ///< traversability_normalized_ratio; NaN where not measured
};

struct FlownMission {
  std::size_t map = 0;  ///< index into FlownSet::maps
  double reference_length_m = 0.0;
  bool has_reached = false;
};

/// One planner in one setting.
struct FlownPlanner {
  std::string label;
  std::vector<FlownMission> trials;
};

/// Flights that success is predicted from, or that a prediction is judged by.
struct FlownSet {
  std::vector<FlownMap> maps;
  std::vector<FlownPlanner> planners;  ///< by label

  /// Index of the map of this key, which is there once.
  std::size_t map_of(const std::string& key, const FlownMap& map);
  FlownPlanner& planner_of(const std::string& label);

 private:
  std::map<std::string, std::size_t> map_at_;
};

/// The fields of trials that tell a planner's settings apart: its sensor and vehicle, and what the
/// sweep varies except its maps. Those that Database::read_sweep() is to read for add_sweeps().
std::vector<std::string> setting_fields(const SweepInfo& sweep);

/// Adds finished trials. A planner that flew in several settings (over all these sweeps) is one
/// planner for each: "ego, sensor stereo_sgm".
void add_sweeps(FlownSet& set, const std::vector<SweepResult>& sweeps);

/// Adds the flights of results of suites; of the maps, which are made and measured here, each once.
/// `track`: where the suite is that the results are of, as suite_track() has it; "": it comes with
/// the program. Labels have the track before them where there are several. Throws InputError for
/// sealed results, whose maps can't be made without their key, and rows of no sweep of the suite.
void add_suite_results(FlownSet& set, const std::vector<SuiteResult>& results,
                       const std::string& track = "");

}  // namespace avoidbench
