#include <algorithm>
#include <functional>

#include "report/table_rows.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/correlation.hpp"
#include "suite/suite_board.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kLeastResults = 3;

using Scores = std::vector<const SuiteScore*>;

/// What ranks results: of each its value and its draws.
struct Ranking {
  std::function<double(const SuiteScore&)> value;
  std::function<const std::vector<double>&(const SuiteScore&)> draws;
};

Ranking by_score() {
  return {.value = [](const SuiteScore& score) { return score.score.value; },
          .draws = [](const SuiteScore& score) -> const std::vector<double>& {
            return score.score_draws;
          }};
}

Ranking by_cell(std::size_t cell) {
  return {.value = [cell](const SuiteScore& score) { return score.cell_v90_mps[cell]; },
          .draws = [cell](const SuiteScore& score) -> const std::vector<double>& {
            return score.cells[cell].v90_draws;
          }};
}

Scores competitors(const Board& board) {
  Scores scores;
  for (const BoardEntry& entry : board.entries) {
    if (!entry.score.is_privileged) scores.push_back(&entry.score);
  }
  return scores;
}

/// τ of `first` by the one ranking and `second`, the same planners, by the other, with the middle
/// 95 % of its draws.
Row agreement_row(const std::string& board, const std::string& with, const Scores& first,
                  const Ranking& of_first, const Scores& second, const Ranking& of_second) {
  std::vector<double> x, y, draws;
  for (const SuiteScore* score : first) x.push_back(of_first.value(*score));
  for (const SuiteScore* score : second) y.push_back(of_second.value(*score));
  const double tau = kendall_correlation(x, y);
  for (std::size_t k = 0; k < kSpeedDraws; ++k) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      x[i] = of_first.draws(*first[i])[k];
      y[i] = of_second.draws(*second[i])[k];
    }
    const double drawn = kendall_correlation(x, y);
    if (drawn == drawn) draws.push_back(drawn);
  }
  std::sort(draws.begin(), draws.end());
  return make_row(board, with, first.size(), tau, quantile(draws, 0.025), quantile(draws, 0.975));
}

}  // namespace

Table agreement_table(const std::vector<Board>& boards) {
  Table table = make_table(
      "agreement", "Kendall's tau between rankings",
      {{.name = "board", .place = Place::key},
       {.name = "with", .doc = "a cell's v90, or the scores on another board", .place = Place::key},
       {.name = "result_count", .header = "results", .doc = "competitors on both sides"},
       {.name = "tau",
        .doc = "1: the same order, 0: none, -1: the opposite one; ties count for neither (tau b); "
               "the interval is of draws of maps",
        .decimals = 2,
        .has_interval = true}});
  for (std::size_t i = 0; i < boards.size(); ++i) {
    const Scores scores = competitors(boards[i]);
    if (scores.size() < kLeastResults) continue;
    const std::vector<SuiteCell>& cells = boards[i].track.suite.cells;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      table.rows.push_back(agreement_row(boards[i].title, cells[cell].name, scores, by_score(),
                                         scores, by_cell(cell)));
    }
    for (std::size_t k = i + 1; k < boards.size(); ++k) {
      Scores here, there;
      for (const SuiteScore* score : scores) {
        for (const SuiteScore* other : competitors(boards[k])) {
          if (other->label != score->label) continue;
          here.push_back(score);
          there.push_back(other);
        }
      }
      if (here.size() < kLeastResults) continue;
      table.rows.push_back(
          agreement_row(boards[i].title, boards[k].title, here, by_score(), there, by_score()));
    }
  }
  return table;
}

}  // namespace avoidbench
