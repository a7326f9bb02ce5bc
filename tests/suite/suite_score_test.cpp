#include "suite/suite_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "suite/suite_samples.hpp"

namespace avoidbench {
namespace {

using suite_samples::large_suite;
using suite_samples::result_of;

/// Cell i reaches i + 1 m/s in all missions: the score is their mean, and nothing is uncertain.
TEST(SuiteScore, IsTheMeanOfTheCells) {
  const SuiteSpec suite = large_suite(3);
  const SuiteScore score =
      score_of(suite, result_of(suite, "a", [](const std::string& cell, auto, auto) {
                 return 1.0 + cell.back() - '0';
               }));
  EXPECT_DOUBLE_EQ(score.score.value, 2.0);
  EXPECT_NEAR(score.score.interval.lower, 2.0, 1e-12);
  EXPECT_NEAR(score.score.interval.upper, 2.0, 1e-12);
  EXPECT_EQ(score.all.trial_count, 180);
  EXPECT_EQ(score.success_count, 180);
  EXPECT_EQ(score.map_count, 36U);
}

/// A cell where more than one mission of ten fails is worth nothing, whatever the others are.
TEST(SuiteScore, ACellWithElevenPercentOfFailuresCountsAsNothing) {
  const SuiteSpec suite = large_suite(2);
  int failed = 0;
  const SuiteScore score =
      score_of(suite, result_of(suite, "a", [&](const std::string& cell, auto, auto mission) {
                 // 7 of 60.
                 if (cell == "cell0" && mission == 0 && failed < 7) return ++failed, 0.0;
                 return 4.0;
               }));
  EXPECT_EQ(score.cells[0].v90.value, 0.0);
  EXPECT_EQ(score.cells[0].crash_count, 7);
  EXPECT_DOUBLE_EQ(score.score.value, 2.0);
}

/// On dev a cell of twelve missions forgives one.
TEST(SuiteScore, IsTheSameNumberOnDev) {
  SuiteSpec suite = large_suite(2);
  suite.open.missions = 1;
  const auto failing = [&](std::int64_t count) {
    return score_of(suite, result_of(suite, "a", [count](const std::string& cell, auto map, auto) {
                      return cell == "cell1" && map < count ? 0.0 : 3.0;
                    }));
  };
  EXPECT_DOUBLE_EQ(failing(1).score.value, 3.0);
  EXPECT_DOUBLE_EQ(failing(2).score.value, 1.5);
  EXPECT_TRUE(std::isnan(failing(1).cells[1].v90.value));  // of a cell alone nothing is said
  const std::vector<Table> tables = score_tables(suite, {failing(1)});
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].columns.back().name, "cell1_v90_mps");
}

/// By hand: v90 of a cell is the 7th slowest of 60.
TEST(SuiteScore, AgreesWithItsDefinition) {
  const SuiteSpec suite = large_suite(2);
  RandomStream random = stream(7, "suite_score_test");
  std::vector<double> slowest[2];
  const SuiteResult result = result_of(suite, "a", [&](const std::string& cell, auto, auto) {
    const double speed = 1.0 + 3.0 * random.uniform();
    slowest[cell.back() - '0'].push_back(20.0 / (20.0 / speed));
    return speed;
  });
  double sum = 0.0;
  for (std::vector<double>& speeds : slowest) {
    std::sort(speeds.begin(), speeds.end());
    sum += speeds[6];
  }
  EXPECT_DOUBLE_EQ(score_of(suite, result).score.value, 0.5 * sum);
}

/// Four cells on the same maps tell no more of them than one. Taken for different maps, as sealed
/// ones are, they would halve the interval.
TEST(SuiteScore, CellsOnTheSameMapsDrawTheSameOnes) {
  const auto score_on = [](std::size_t cell_count, bool are_same, Split split = Split::open) {
    SuiteSpec suite = large_suite(cell_count);
    for (std::size_t i = 0; i < cell_count; ++i) {
      const std::string digest(64, are_same ? 'a' : static_cast<char>('a' + i));
      for (SuiteSweep& sweep : suite.cells[i].sweeps) sweep.dev = sweep.open = {digest, digest};
    }
    SuiteResult result = result_of(suite, "a", [](auto&, std::int64_t map, auto) {
      return 1.0 + 0.1 * static_cast<double>(map);
    });
    result.split = split;
    return score_of(suite, result);
  };
  const SuiteScore one = score_on(1, true), same = score_on(4, true);
  EXPECT_NEAR(same.score.interval.lower, one.score.interval.lower, 1e-12);
  EXPECT_NEAR(same.score.interval.upper, one.score.interval.upper, 1e-12);
  EXPECT_EQ(same.map_count, 12U);
  for (const SuiteScore& other : {score_on(4, false), score_on(4, true, Split::sealed)}) {
    EXPECT_LT(other.score.interval.upper - other.score.interval.lower,
              0.8 * (one.score.interval.upper - one.score.interval.lower));
    EXPECT_EQ(other.map_count, 48U);
  }
}

TEST(SuiteScore, RanksRivalsBelowWhoSeesTheMapAndMarksTheBest) {
  const SuiteSpec suite = large_suite(2);
  const auto at = [&](const std::string& label, double speed, bool is_privileged = false) {
    SuiteResult result = result_of(suite, label, [speed](auto&, auto, auto) { return speed; });
    result.is_privileged = is_privileged;
    return score_of(suite, result);
  };
  const std::vector<SuiteScore> scores =
      ranked({at("slow", 1.0), at("fast", 3.0), at("knows", 2.0, true)});
  EXPECT_EQ(scores[0].label, "knows");
  EXPECT_EQ(scores[1].label, "fast");
  EXPECT_FALSE(scores[0].is_best);
  EXPECT_TRUE(scores[1].is_best);
  EXPECT_NEAR(score_difference(scores[1], scores[2]).interval.lower, 2.0, 1e-12);
  EXPECT_FALSE(ranked({at("a", 2.0), at("b", 2.0)})[0].is_best);
}

/// Speeds of a planner in a suite whose maps differ, as missions do: `map_part` of the maps, the
/// same for planners that are compared.
SuiteScore synthetic(const SuiteSpec& suite, RandomStream& random,
                     const std::vector<double>& map_part, double faster_mps) {
  std::size_t at = 0;
  return score_of(suite, result_of(suite, "a", [&](auto&, auto, std::int64_t mission) {
                    const double map_mps = map_part[at];
                    if (mission == 4) ++at;
                    return std::max(0.01, 2.0 + faster_mps + map_mps + 0.5 * random.normal());
                  }));
}

/// In how many of 300 suites do intervals hold the score of endless maps, and the difference of two
/// planners? v90 of 60 missions is the 7th slowest, a little above the tenth part of all: eight
/// cells share that, and it cancels in differences.
TEST(SuiteScore, ItsIntervalsHoldTheTruth) {
  const SuiteSpec suite = large_suite(8);
  RandomStream random = stream(3, "coverage");
  // The sum of two normals: 0.3 of maps and 0.5 of missions.
  const double truth = 2.0 - 1.2815515655446004 * std::sqrt(0.3 * 0.3 + 0.5 * 0.5);
  int held = 0, held_difference = 0;
  constexpr int kSuites = 300;
  for (int i = 0; i < kSuites; ++i) {
    std::vector<double> map_part(8 * 12);
    for (double& part : map_part) part = 0.3 * random.normal();
    const SuiteScore slow = synthetic(suite, random, map_part, 0.0);
    const SuiteScore fast = synthetic(suite, random, map_part, 0.2);
    const Interval interval = slow.score.interval;
    const Interval difference = score_difference(fast, slow).interval;
    held += interval.lower <= truth && truth <= interval.upper ? 1 : 0;
    held_difference += difference.lower <= 0.2 && 0.2 <= difference.upper ? 1 : 0;
  }
  // 93.7 and 97.7 %.
  EXPECT_GE(held, 273) << "of " << kSuites;
  EXPECT_LE(held, 294) << "of " << kSuites;
  EXPECT_GE(held_difference, 282) << "of " << kSuites;
}

}  // namespace
}  // namespace avoidbench
