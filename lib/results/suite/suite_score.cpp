#include "suite/suite_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/normal_quantile.hpp"
#include "report/table_rows.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/distributions.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

/// Flights with the maps that they are on, by number.
class FlownMaps {
 public:
  void add(const SuiteRow& row) {
    const auto place = maps_.emplace(std::tuple(row.cell, row.sweep, row.map_seed), maps_.size());
    trials_.push_back({.map = place.first->second, .speed_mps = row.goal_velocity_mps});
    crash_count_ += row.outcome == Outcome::collided ? 1 : 0;
    if (!std::isnan(row.path_length_m)) flown_m_ += row.path_length_m;
  }
  std::size_t map_count() const { return maps_.size(); }
  PlannerSpeeds speeds(std::uint64_t stream_index) const {
    return speeds_of(trials_, crash_count_, flown_m_, maps_.size(), stream_index);
  }

 private:
  std::map<std::tuple<std::string, std::string, std::uint64_t>, std::size_t> maps_;
  std::vector<SpeedTrial> trials_;
  std::int64_t crash_count_ = 0;
  double flown_m_ = 0.0;
};

/// The bias-corrected percentile interval (Efron 1987) of a score: v90 of few missions lies above
/// that of endless ones, and draws tell by how much. Widened as for the maps of one cell, since
/// they do not tell all of it: see the test for what it holds.
Interval interval_of(double value, const std::vector<double>& draws, std::size_t map_count) {
  double below = 0.0;
  for (const double draw : draws) below += draw < value ? 1.0 : draw == value ? 0.5 : 0.0;
  const auto count = static_cast<double>(draws.size());
  const double shift = 2.0 * normal_quantile(std::clamp(below, 0.5, count - 0.5) / count);
  const auto n = static_cast<double>(map_count);
  const double widened = std::sqrt(n / (n - 1.0)) * student_t_quantile(0.975, n - 1.0);
  return {quantile(draws, normal_cdf(shift - widened)),
          quantile(draws, normal_cdf(shift + widened))};
}

/// Sealed maps are other ones in each cell.
bool have_same_maps(const SuiteCell& a, const SuiteCell& b, Split split) {
  const auto frozen = [split](const SuiteSweep& sweep) -> const std::string& {
    return (split == Split::dev ? sweep.dev : sweep.open).maps_sha256;
  };
  return split != Split::sealed &&
         std::equal(a.sweeps.begin(), a.sweeps.end(), b.sweeps.begin(), b.sweeps.end(),
                    [&](const SuiteSweep& x, const SuiteSweep& y) {
                      return !frozen(x).empty() && frozen(x) == frozen(y);
                    });
}

/// The first cell on the maps of cell i. Cells on the same maps draw the same ones, since a map
/// that is easy in one of them is easy in all; others have nothing to do with each other.
std::size_t first_on_its_maps(const std::vector<SuiteCell>& cells, std::size_t i, Split split) {
  std::size_t first = 0;
  while (first < i && !have_same_maps(cells[first], cells[i], split)) ++first;
  return first;
}

double success_rate(const SuiteScore& score) {
  return static_cast<double>(score.success_count) / static_cast<double>(score.all.trial_count);
}

Table scores_table(const SuiteSpec& suite, const std::vector<SuiteScore>& scores) {
  std::vector<Column> columns{planner_column(),
                              {.name = "score_mps",
                               .header = "score",
                               .unit = "m/s",
                               .doc = "the number that ranks, with its 95 % interval",
                               .decimals = 2,
                               .has_interval = true},
                              {.name = "missions"},
                              {.name = "success_rate", .header = "success", .decimals = 3},
                              {.name = "crashes_per_km",
                               .header = "crashes",
                               .unit = "1/km",
                               .decimals = 1,
                               .has_interval = true}};
  for (const SuiteCell& cell : suite.cells) {
    columns.push_back(
        {.name = cell.name + "_v90_mps", .header = cell.name, .unit = "m/s", .decimals = 2});
  }
  Table table = make_table("scores", "Scores: the mean of the cells' v90", columns);
  for (const SuiteScore& score : scores) {
    Row& row = table.rows.emplace_back();
    append(row, score.label + (score.is_privileged ? " (sees the map)" : ""));
    append(row, best_cell(score.score.value, score.is_best));
    append(row, score.score.interval);
    append(row, score.all.trial_count);
    append(row, success_rate(score));
    append(row, score.all.crashes_per_km.value);
    append(row, score.all.crashes_per_km.interval);
    for (const double v90_mps : score.cell_v90_mps) append(row, v90_mps);
  }
  return table;
}

Table differences_table(const std::vector<SuiteScore>& scores) {
  Table table = make_table(
      "differences", "Which results differ: in score, and by success alone",
      {{.name = "first", .place = Place::key},
       {.name = "second", .place = Place::key},
       {.name = "difference_mps",
        .header = "Δ score",
        .unit = "m/s",
        .doc = "first - second, with its 95 % interval over maps",
        .decimals = 2,
        .has_interval = true},
       {.name = "score_p", .header = "p", .doc = "of no difference in score", .decimals = 4},
       {.name = "success_difference", .header = "Δ success", .decimals = 3},
       {.name = "success_p",
        .header = "p of success",
        .doc = "of no difference in success (Fisher's exact test)",
        .decimals = 4}});
  for (std::size_t i = 0; i < scores.size(); ++i) {
    for (std::size_t k = i + 1; k < scores.size(); ++k) {
      const SuiteScore &first = scores[i], &second = scores[k];
      const SpeedDifference found = score_difference(first, second);
      Row& row = table.rows.emplace_back();
      append(row, first.label);
      append(row, second.label);
      append(row, found.difference_mps);
      append(row, found.interval);
      append(row, found.p);
      append(row, success_rate(first) - success_rate(second));
      append(row, fisher_exact_p(first.success_count, first.all.trial_count, second.success_count,
                                 second.all.trial_count));
    }
  }
  return table;
}

}  // namespace

SuiteScore score_of(const SuiteSpec& suite, const SuiteResult& result) {
  SuiteScore score;
  score.label = result.label;
  score.is_privileged = result.is_privileged;
  FlownMaps all;
  std::map<std::string, FlownMaps> by_cell;
  for (const SuiteRow& row : result.rows) {
    all.add(row);
    by_cell[row.cell].add(row);
    score.success_count += row.outcome == Outcome::reached_goal ? 1 : 0;
  }
  score.all = all.speeds(0);
  std::size_t least_maps = all.map_count();
  score.score_draws.assign(kSpeedDraws, 0.0);
  const auto count = static_cast<double>(suite.cells.size());
  for (std::size_t i = 0; i < suite.cells.size(); ++i) {
    const FlownMaps& flown = by_cell[suite.cells[i].name];
    least_maps = std::min(least_maps, flown.map_count());
    const std::size_t first = first_on_its_maps(suite.cells, i, result.split);
    if (first == i) score.map_count += flown.map_count();
    const PlannerSpeeds& cell = score.cells.emplace_back(flown.speeds(first + 1));
    score.cell_v90_mps.push_back(reached_speed(cell.curve, kReachedShare));
    score.score.value += score.cell_v90_mps.back() / count;
    for (std::size_t k = 0; k < kSpeedDraws; ++k) score.score_draws[k] += cell.v90_draws[k] / count;
  }
  score.score.interval = interval_of(score.score.value, score.score_draws, least_maps);
  return score;
}

SpeedDifference score_difference(const SuiteScore& first, const SuiteScore& second,
                                 double confidence) {
  return speed_difference(first.score.value, second.score.value, first.score_draws,
                          second.score_draws, std::min(first.map_count, second.map_count),
                          confidence);
}

std::vector<SuiteScore> ranked(std::vector<SuiteScore> scores) {
  std::stable_sort(scores.begin(), scores.end(), [](const SuiteScore& a, const SuiteScore& b) {
    if (a.is_privileged != b.is_privileged) return a.is_privileged;
    return a.score.value > b.score.value ||
           (!std::isnan(a.score.value) && std::isnan(b.score.value));
  });
  std::vector<SuiteScore*> rivals;
  for (SuiteScore& score : scores) {
    if (!score.is_privileged && !std::isnan(score.score.value)) rivals.push_back(&score);
  }
  if (rivals.size() < 2) return scores;
  const double confidence = 1.0 - kAlpha / static_cast<double>(rivals.size() - 1);
  rivals.front()->is_best =
      std::all_of(rivals.begin() + 1, rivals.end(), [&](const SuiteScore* other) {
        return score_difference(*rivals.front(), *other, confidence).interval.lower > 0.0;
      });
  return scores;
}

std::vector<Table> score_tables(const SuiteSpec& suite, const std::vector<SuiteScore>& scores) {
  std::vector<Table> tables{scores_table(suite, scores)};
  if (scores.size() > 1) tables.push_back(differences_table(scores));
  return tables;
}

}  // namespace avoidbench
