#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/speeds.hpp"
#include "suite/suite_result.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// What a result is worth. The score is the mean of the cells' v90, of which none needs more
/// missions than it has; where one has too few (on dev), the v90 of all missions together.
struct SuiteScore {
  std::string label;
  bool is_privileged = false;       ///< sees the map: no competitor
  Estimate score;                   ///< m/s; NaN for fewer missions than v90 needs
  std::vector<double> score_draws;  ///< pairs with another result's of the same suite and split
  bool is_mean_of_cells = false;
  std::size_t map_count = 0;  ///< that its interval rests on: of the smallest cell, or of all
  std::int64_t success_count = 0;
  PlannerSpeeds all;                 ///< of all missions together
  std::vector<PlannerSpeeds> cells;  ///< one a cell of the suite
  bool is_best = false;              ///< clearly above every other competitor's
};

SuiteScore score_of(const SuiteSpec& suite, const SuiteResult& result);

/// Scores of one track and split, the greatest first, those that see the map above all; marks the
/// best.
std::vector<SuiteScore> ranked(std::vector<SuiteScore> scores);

/// Of two results' scores: a bootstrap over the maps of each cell, the same for both.
SpeedDifference score_difference(const SuiteScore& first, const SuiteScore& second,
                                 double confidence = 0.95);

/// Tables `scores` (a row a result, v90 of each cell beside its score; of cells that are too small
/// for that the mean goal velocity) and `differences` (a row a pair, beside what success alone
/// tells of it).
std::vector<Table> score_tables(const SuiteSpec& suite, const std::vector<SuiteScore>& scores);

}  // namespace avoidbench
