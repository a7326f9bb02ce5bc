#include <gtest/gtest.h>

#include "suite/suite_board.hpp"
#include "suite/suite_samples.hpp"

namespace avoidbench {
namespace {

/// Results a, b, c, d of two cells: in cell0 a is the slowest, in cell1 the fastest, the others in
/// their order; all missions are alike, so that nothing is uncertain.
Board board_of(const std::string& title, double factor) {
  Board board;
  board.track.suite = suite_samples::large_suite(2);
  board.title = title;
  for (const char label : {'a', 'b', 'c', 'd'}) {
    const double speed = 1.0 + (label - 'a');
    SuiteResult result = suite_samples::result_of(
        board.track.suite, std::string(1, label), [&](const std::string& cell, auto, auto) {
          return factor * (cell == "cell1" && label == 'a' ? 4.5 : speed);
        });
    SuiteScore score = score_of(board.track.suite, result);
    board.entries.push_back({.result = std::move(result), .score = std::move(score), .folder = {}});
  }
  return board;
}

double tau_at(const Table& table, std::size_t row) {
  return std::get<double>(table.rows[row][3].value);
}

TEST(SuiteAgreement, OfCellsAndOfBoards) {
  Board second = board_of("second", 2.0);
  std::swap(second.entries[0].score.label, second.entries[1].score.label);
  const Table table = agreement_table({board_of("first", 1.0), second});
  // Two cells of each, and the boards with each other.
  ASSERT_EQ(table.rows.size(), 5U);
  // Scores: a 2.75, b 2, c 3, d 4; in cell0 a is below b, in cell1 above all.
  EXPECT_NEAR(tau_at(table, 0), 4.0 / 6.0, 1e-12);
  EXPECT_NEAR(tau_at(table, 1), 2.0 / 6.0, 1e-12);
  EXPECT_NEAR(std::get<double>(table.rows[0][4].value), 4.0 / 6.0, 1e-12);
  EXPECT_EQ(std::get<std::string>(table.rows[2][1].value), "second");
  EXPECT_NEAR(tau_at(table, 2), 4.0 / 6.0, 1e-12);  // a and b by the other's scores
}

TEST(SuiteAgreement, IsOfThreeCompetitorsAtLeast) {
  Board board = board_of("first", 1.0);
  board.entries[0].score.is_privileged = true;
  EXPECT_EQ(agreement_table({board}).rows.size(), 2U);
  EXPECT_EQ(std::get<std::uint64_t>(agreement_table({board}).rows[0][2].value), 3U);
  board.entries.pop_back();
  EXPECT_TRUE(agreement_table({board}).rows.empty());
}

}  // namespace
}  // namespace avoidbench
