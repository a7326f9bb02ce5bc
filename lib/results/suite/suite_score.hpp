#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/speeds.hpp"
#include "suite/suite_result.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// What a result is worth: the mean of the cells' v90. A cell of dev has too few missions for a v90
/// of its own to say much (least_trials_for()); the mean of eight says more, and its interval how
/// much.
struct SuiteScore {
  std::string label;
  bool is_privileged = false;       ///< sees the map: no competitor
  Estimate score;                   ///< m/s
  std::vector<double> score_draws;  ///< pairs with another result's of the same suite and split
  std::size_t map_count = 0;        ///< of all cells; what two cells share counts once
  std::int64_t success_count = 0;
  PlannerSpeeds all;                 ///< of all missions together
  std::vector<PlannerSpeeds> cells;  ///< one a cell of the suite
  std::vector<double> cell_v90_mps;  ///< whatever the number of missions
  bool is_best = false;              ///< clearly above every other competitor's
};

SuiteScore score_of(const SuiteSpec& suite, const SuiteResult& result);

/// Scores of one track and split, the greatest first, those that see the map above all; marks the
/// best.
std::vector<SuiteScore> ranked(std::vector<SuiteScore> scores);

/// Of two results' scores: a bootstrap over the maps of each cell, the same for both and for cells
/// on the same maps.
SpeedDifference score_difference(const SuiteScore& first, const SuiteScore& second,
                                 double confidence = 0.95);

/// Tables `scores` (a row a result, v90 of each cell beside its score) and `differences` (a row a
/// pair, beside what success alone tells of it).
std::vector<Table> score_tables(const SuiteSpec& suite, const std::vector<SuiteScore>& scores);

}  // namespace avoidbench
