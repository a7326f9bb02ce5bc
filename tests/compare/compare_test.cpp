#include "compare/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/input_error.hpp"
#include "compare/compare_samples.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using namespace compare_samples;

TEST(Compare, EqualRunsAreTheSame) {
  const TrialTable table = finished_table("a.db", 5, 4);
  const Comparison comparison = compare_tables(table, table, {});
  for (const MetricComparison& row : comparison.rows) {
    EXPECT_EQ(row.change, 0.0) << row.metric;
    EXPECT_EQ(row.pair_count, 20) << row.metric;
    EXPECT_TRUE(row.verdict == Verdict::same || row.verdict == Verdict::not_gated) << row.metric;
  }
  EXPECT_TRUE(comparison.flips.empty());
  EXPECT_EQ(comparison.test_count, 5);  // SR, PO, AGV, MP, clearance; the measured one is not gated
}

TEST(Compare, ASlowerPlannerFailsByV90) {
  const TrialTable base = finished_table("a.db", 8, 5);
  TrialTable now = finished_table("b.db", 8, 5);
  for (TableTrial& trial : now.trials) trial.metrics[1] = trial.mission % 2 == 0 ? 1.5 : 1.6;
  const Comparison comparison = compare_tables(base, now, {});
  const MetricComparison& speed = row_of(comparison, "v90_mps");
  EXPECT_EQ(speed.base_mean, 2.0);
  EXPECT_EQ(speed.new_mean, 1.5);
  EXPECT_EQ(speed.change, -0.5);
  EXPECT_EQ(speed.p, std::ldexp(1.0, -7));  // eight maps that all differ one way
  EXPECT_EQ(speed.verdict, Verdict::unclear);
  CompareSettings settings;
  settings.alpha = 0.05;
  EXPECT_EQ(row_of(compare_tables(base, now, settings), "v90_mps").verdict, Verdict::regression);
  // Of 28 pairs nothing is said.
  for (const MetricComparison& row :
       compare_tables(finished_table("a.db", 7, 4), finished_table("b.db", 7, 4), {}).rows) {
    EXPECT_NE(row.metric, "v90_mps");
  }
}

TEST(Compare, LostTrialsAreARegressionWithMcNemarsP) {
  const TrialTable base = finished_table("a.db", 5, 8);
  TrialTable now = finished_table("b.db", 5, 8);
  for (std::size_t i = 0; i < 40; i += 2) crash(now.trials[i]);
  const Comparison comparison = compare_tables(base, now, {});
  const MetricComparison& rate = row_of(comparison, "success_rate");
  EXPECT_EQ(rate.base_mean, 1.0);
  EXPECT_EQ(rate.new_mean, 0.5);
  EXPECT_NEAR(rate.p / std::ldexp(1.0, -19), 1.0, 1e-12);  // 2 · 2^-20
  EXPECT_NEAR(rate.adjusted_p / rate.p, 6.0, 1e-12);       // first of six tests
  EXPECT_EQ(rate.verdict, Verdict::regression);
  EXPECT_EQ(comparison.flips.size(), 20U);
  EXPECT_EQ(comparison.planners[0].lost_count, 20);
  // The other way round it is an improvement.
  EXPECT_EQ(row_of(compare_tables(now, base, {}), "success_rate").verdict, Verdict::improvement);
}

TEST(Compare, ARegressionNeedsBothLimits) {
  const TrialTable base = finished_table("a.db", 10, 4);
  const auto verdict_at = [&](double factor, int changed, const CompareSettings& settings) {
    TrialTable now = finished_table("b.db", 10, 4);
    for (int i = 0; i < changed; ++i) now.trials[static_cast<std::size_t>(i)].metrics[0] *= factor;
    return row_of(compare_tables(base, now, settings), "path_optimality_pct").verdict;
  };
  EXPECT_EQ(verdict_at(1.2, 40, {}), Verdict::regression);
  EXPECT_EQ(verdict_at(0.8, 40, {}), Verdict::improvement);
  EXPECT_EQ(verdict_at(1.02, 40, {}), Verdict::small);  // sure, but 2 %
  EXPECT_EQ(verdict_at(9.0, 2, {}), Verdict::unclear);  // 40 %, but of two missions only
  EXPECT_EQ(verdict_at(1.0, 40, {}), Verdict::same);
  CompareSettings settings;
  settings.tolerances["path_optimality_pct"] = {Tolerance::Kind::absolute, 2.0};
  EXPECT_EQ(verdict_at(1.2, 40, settings), Verdict::small);  // 1 % point
  EXPECT_EQ(verdict_at(1.5, 40, settings), Verdict::regression);
  // A share of the base's mean: 10 % of it are 9.1 % of the new one.
  settings.tolerances["path_optimality_pct"] = {Tolerance::Kind::relative, 0.095};
  EXPECT_EQ(verdict_at(1.1, 40, settings), Verdict::regression);
  EXPECT_EQ(verdict_at(0.91, 40, settings), Verdict::small);  // 9.9 % of the new one
  settings.tolerances["path_optimality_pct"] = {Tolerance::Kind::relative, 0.25};
  EXPECT_EQ(verdict_at(1.25, 40, settings), Verdict::regression) << "at the tolerance";
  settings.tolerances["path_optimality_pct"] = {Tolerance::Kind::ignored, 0.0};
  EXPECT_EQ(verdict_at(9.0, 40, settings), Verdict::not_gated);
}

TEST(Compare, MeasuredMetricsGateOnlyWhereAskedFor) {
  const TrialTable base = finished_table("a.db", 10, 4);
  TrialTable now = finished_table("b.db", 10, 4);
  for (TableTrial& trial : now.trials) trial.metrics[7] *= 2.0;
  CompareSettings settings;
  const Comparison shown = compare_tables(base, now, settings);
  EXPECT_EQ(row_of(shown, "processing_time_ms").verdict, Verdict::not_gated);
  EXPECT_EQ(row_of(shown, "processing_time_ms").change, 1.5);
  settings.gates_measured = true;
  EXPECT_EQ(row_of(compare_tables(base, now, settings), "processing_time_ms").verdict,
            Verdict::regression);
}

TEST(Compare, TrialsOfOneSideAreCountedAndTold) {
  TrialTable base = finished_table("a.db", 3, 4), now = finished_table("b.db", 3, 4);
  base.trials.pop_back();
  now.trials.erase(now.trials.begin(), now.trials.begin() + 3);
  now.trials.push_back(trial("reactive", 0, 0, true));
  const Comparison comparison = compare_tables(base, now, {});
  ASSERT_EQ(comparison.planners.size(), 2U);
  EXPECT_EQ(comparison.planners[0].pair_count, 8);
  EXPECT_EQ(comparison.planners[0].only_base_count, 3);
  EXPECT_EQ(comparison.planners[0].only_new_count, 1);
  EXPECT_EQ(comparison.planners[1].pair_count, 0);
  std::string all;
  for (const std::string& warning : comparison.warnings) all += warning + "\n";
  EXPECT_NE(all.find("ego: 3 trials only in the base, 1 trial only in the new results"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("reactive: 1 trial only in the new results; none is compared"),
            std::string::npos)
      << all;
}

TEST(Compare, OtherWorldsBehindTheSameNamesAreTold) {
  const TrialTable base = finished_table("a.db", 3, 4);
  TrialTable now = base;
  now.trials[5].mission += 1;
  const Comparison comparison = compare_tables(base, now, {});
  ASSERT_FALSE(comparison.warnings.empty());
  EXPECT_EQ(comparison.warnings.back().find("1 pair of 12 flew in another world"), 0U);
}

TEST(Compare, WhatCantBeComparedIsRefused) {
  const TrialTable base = finished_table("a.db", 3, 4);
  TrialTable now = finished_table("b.db", 3, 4);
  now.metrics[0].version = 2;
  EXPECT_EQ(test::message_of([&] { compare_tables(base, now, {}); }),
            "path_optimality_pct is defined in version 1 in a.db and in version 2 in b.db: values "
            "of the two can't be compared; make the base again");
  EXPECT_NE(test::message_of([&] { compare_exactly(base, now); }).find("version"),
            std::string::npos);
  const TrialTable others = finished_table("c.db", 3, 4, "reactive");
  EXPECT_NE(test::message_of([&] {
              compare_tables(base, others, {});
            }).find("no trial of a.db is in c.db"),
            std::string::npos);
  CompareSettings settings;
  settings.metrics = {"path_optimality"};
  EXPECT_NE(test::message_of([&] {
              compare_tables(base, base, settings);
            }).find("did you mean path_optimality_pct?"),
            std::string::npos);
}

/// Crashing on the hard missions drops the long detours from the mean of path optimality: that must
/// not look better.
TEST(Compare, CrashingOnHardMissionsImprovesNothing) {
  TrialTable base = finished_table("a.db", 10, 6);
  for (std::size_t i = 0; i < base.trials.size(); i += 3) base.trials[i].metrics[0] = 60.0;
  TrialTable now = base;
  for (std::size_t i = 0; i < now.trials.size(); i += 3) crash(now.trials[i]);
  const Comparison comparison = compare_tables(base, now, {});
  EXPECT_EQ(row_of(comparison, "success_rate").verdict, Verdict::regression);
  EXPECT_EQ(row_of(comparison, "path_optimality_pct").change, 0.0);
  EXPECT_EQ(row_of(comparison, "path_optimality_pct").pair_count, 40);
  EXPECT_EQ(count_of(comparison, Verdict::improvement), 0);
}

/// Whatever finished trials turn into failures of whatever kind and values, no metric is better.
TEST(Compare, FailuresImproveNoMetric) {
  CompareSettings settings;
  settings.metrics = {"all"};
  settings.replicate_count = 100;
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto natures = mission_natures(6, 5, seed);
    const TrialTable base = flown_table("a.db", natures, 5, seed);
    TrialTable now = base;
    RandomStream random = stream(seed, "crashes");
    const double share = random.uniform();
    for (TableTrial& trial : now.trials) {
      const double drawn = random.uniform(), size = random.uniform(0.0, 100.0);
      if (trial.outcome != Outcome::reached_goal || drawn > share) continue;
      const bool collides = size < 50.0;
      trial.outcome = collides ? Outcome::collided : Outcome::timed_out;
      trial.metrics = {kNone, kNone, size, 0.02 * size, size, collides ? 1.0 : 0.0, size, 0.01};
    }
    for (const MetricComparison& row : compare_tables(base, now, settings).rows) {
      if (row.better == Better::neither || row.pair_count == 0) continue;
      const double gain = row.better == Better::more ? row.change : -row.change;
      EXPECT_LE(gain, 0.0) << row.metric << ", seed " << seed;
      EXPECT_NE(row.verdict, Verdict::improvement) << row.metric << ", seed " << seed;
      ++compared;
    }
  }
  EXPECT_GT(compared, 600);
}

TEST(Compare, IntervalOfManyMapsAgreesWithTheBootstrap) {
  // 300 maps are drawn, 301 are not: the interval of a mean must not jump.
  const auto half_width = [](int map_count) {
    const auto natures = mission_natures(map_count, 2, 7);
    const TrialTable base = flown_table("a.db", natures, 2, 1);
    const TrialTable now = flown_table("b.db", natures, 2, 2);
    const Interval interval = row_of(compare_tables(base, now, {}), "success_rate").change_interval;
    return 0.5 * (interval.upper - interval.lower);
  };
  EXPECT_NEAR(half_width(301) / half_width(300), 1.0, 0.06);
}

TEST(CompareExact, NamesEveryDifference) {
  const TrialTable base = finished_table("a.db", 2, 3);
  TrialTable now = base;
  EXPECT_TRUE(compare_exactly(base, now).differences.empty());
  now.trials[1].metrics[0] = std::nextafter(5.0, 6.0);
  now.trials[2].metrics[7] = 99.0;  // measured: differs from run to run
  ++now.trials[2].flight;
  crash(now.trials[3]);
  now.trials.pop_back();
  now.trials.push_back(trial("reactive", 0, 0, true));
  const ExactComparison comparison = compare_exactly(base, now);
  EXPECT_EQ(comparison.pair_count, 5);
  EXPECT_EQ(comparison.equal_count, 2);
  ASSERT_GE(comparison.differences.size(), 4U);
  EXPECT_EQ(comparison.differences[0].what, "path_optimality_pct");
  EXPECT_EQ(comparison.differences[0].before, "5");
  EXPECT_EQ(comparison.differences[0].after, "5.000000000000001");
  EXPECT_EQ(comparison.differences[1].what, "flight");
  EXPECT_EQ(comparison.differences[1].after, "another trajectory, command or event");
  EXPECT_EQ(comparison.differences[2].what, "outcome");
  EXPECT_EQ(comparison.differences[2].after, "collided");
  EXPECT_EQ(comparison.differences[3].after, "none");
  EXPECT_EQ(comparison.differences.end()[-2].after, "missing");
  EXPECT_EQ(comparison.differences.back().before, "missing");
}

TEST(CompareExact, FlightsThatATableLacksAreNotCompared) {
  TrialTable base = finished_table("a.db", 1, 2);
  const TrialTable now = base;
  base.trials[0].flight = 0;
  ++base.trials[1].flight;
  const ExactComparison comparison = compare_exactly(base, now);
  EXPECT_EQ(comparison.flight_count, 1);
  EXPECT_EQ(comparison.differences.size(), 1U);
  ASSERT_EQ(comparison.warnings.size(), 1U);
  EXPECT_EQ(comparison.warnings[0],
            "the digest of 1 flight is not in both: only outcomes and metrics are compared");
}

TEST(CompareExact, ASampleMayLackTrialsButHasNoOthers) {
  const TrialTable base = finished_table("a.db", 2, 3);
  TrialTable now = base;
  now.trials.resize(2);
  EXPECT_EQ(compare_exactly(base, now).differences.size(), 4U);
  EXPECT_TRUE(compare_exactly(base, now, true).differences.empty());
  EXPECT_EQ(compare_exactly(base, now, true).equal_count, 2);
  now.trials.push_back(trial("reactive", 0, 0, true));
  const ExactComparison comparison = compare_exactly(base, now, true);
  ASSERT_EQ(comparison.differences.size(), 1U);
  EXPECT_EQ(comparison.differences[0].before, "missing");
  now.trials.erase(now.trials.begin(), now.trials.begin() + 2);
  EXPECT_EQ(test::message_of([&] { compare_exactly(base, now, true); }),
            "a.db has no trial of a.db");
}

TEST(CompareExact, TellsSignedZerosApartAndTakesNoValueForNoValue) {
  TrialTable base = finished_table("a.db", 1, 2);
  base.trials[0].metrics[5] = 0.0;
  base.trials[1].metrics[5] = kNone;
  TrialTable now = base;
  now.trials[0].metrics[5] = -0.0;
  now.trials[1].metrics[5] = -kNone;
  ASSERT_EQ(compare_exactly(base, now).differences.size(), 1U);
  EXPECT_EQ(compare_exactly(base, now).differences[0].after, "-0");
}

TEST(Compare, CausesThatGrew) {
  const TrialTable base = finished_table("base.db", 2, 6);
  TrialTable now = base;
  for (std::size_t i = 0; i < 5; ++i) {
    crash(now.trials[i]);
    now.trials[i].cause = i < 4 ? "occluded" : "tracking";
  }
  Comparison comparison = compare_tables(base, now, {});
  ASSERT_EQ(comparison.causes.size(), 2U);
  EXPECT_EQ(comparison.causes[0].cause, "occluded");
  EXPECT_EQ(comparison.causes[0].base_count, 0);
  EXPECT_EQ(comparison.causes[0].new_count, 4);
  EXPECT_EQ(comparison.causes[0].pair_count, 12);
  EXPECT_NEAR(comparison.causes[0].p, 0.125, 1e-12);  // 2 / 2⁴
  EXPECT_EQ(comparison.causes[1].new_count, 1);
  // A failure whose cause nobody told could be of any.
  now.trials[2].cause.clear();
  EXPECT_TRUE(compare_tables(base, now, {}).causes.empty());
}

}  // namespace
}  // namespace avoidbench
