#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/summary.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// One sweep of a page.
struct PageSweep {
  SweepSummary summary;
  Section section;     ///< its tables, as `report` gives them
  SweepResult result;  ///< its trials, those that the report is of, with the fields `axes`
  std::vector<std::string> axes;
  std::map<std::string, TrialListing> listing_of;  ///< by trial key
  std::vector<RunRow> runs;                        ///< that flew it, the first one first
  /// By trial key, of trials whose failure has been explained: one line.
  std::map<std::string, std::string> cause_of = {};
};

/// A table with its columns, as the page's program reads it.
nlohmann::ordered_json table_json(const Table& table);

/// All of a sweep but its flights: tables, curves, planners, maps, and of each trial its numbers.
nlohmann::ordered_json sweep_json(const PageSweep& sweep);

/// What a page takes for the planners of a sweep: the result's, or, where a limit is looked for,
/// each once, whatever the field's value.
struct PagePlanners {
  std::vector<std::string> labels;
  std::vector<std::size_t> rows;       ///< of each its first one in SweepResult::planners
  std::vector<std::size_t> of_trials;  ///< for each trial of the result an index
};
PagePlanners page_planners(const PageSweep& sweep);

/// For each trial of the result the index of its map.
std::vector<std::size_t> maps_of(const SweepResult& result);

/// "forest, seed 1, poisson_radius_m 3.5", with what the sweep varies of its maps.
std::string map_text(const MapRow& map, const std::vector<std::string>& axes);

}  // namespace avoidbench
