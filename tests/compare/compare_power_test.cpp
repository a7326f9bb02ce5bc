#include <gtest/gtest.h>

#include "compare/compare_samples.hpp"

/// How often comparisons cry wolf, and how often they hear one.
namespace avoidbench {
namespace {

using namespace compare_samples;

constexpr int kMaps = 30, kMissions = 10;

CompareSettings quick_settings() {
  CompareSettings settings;
  settings.replicate_count = 20;  // intervals decide nothing
  return settings;
}

/// Share of comparisons of two runs of one planner with other luck that find a regression.
double false_alarm_rate(int count) {
  int alarms = 0;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const auto natures = mission_natures(kMaps, kMissions, seed);
    const TrialTable base = flown_table("a.db", natures, kMissions, 2 * seed + 1);
    const TrialTable now = flown_table("b.db", natures, kMissions, 2 * seed + 2);
    CompareSettings settings = quick_settings();
    settings.tolerance.value = 0.0;  // by chance alone, whatever the size
    alarms += count_of(compare_tables(base, now, settings), Verdict::regression) > 0 ? 1 : 0;
  }
  return static_cast<double>(alarms) / count;
}

/// Share of comparisons that find a loss of 10 points of success over 300 missions: base's flights
/// with extra failures, and `churn` of the missions ending otherwise by chance, each way.
double detection_rate(int count, double churn) {
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const auto natures = mission_natures(kMaps, kMissions, seed);
    const TrialTable base = flown_table("a.db", natures, kMissions, seed);
    TrialTable now = base;
    double finished = 0.0;
    for (const TableTrial& row : base.trials) {
      finished += row.outcome == Outcome::reached_goal ? 1.0 : 0.0;
    }
    const auto all = static_cast<double>(base.trials.size());
    RandomStream random = stream(seed, "loss");
    for (TableTrial& row : now.trials) {
      const double drawn = random.uniform();
      if (row.outcome == Outcome::reached_goal) {
        if (drawn < (0.1 + churn) * all / finished) crash(row);
      } else if (drawn < churn * all / (all - finished)) {
        row = trial("ego", static_cast<int>(row.identity.map_seed),
                    static_cast<int>(row.identity.mission_index), true);
      }
    }
    const Comparison comparison = compare_tables(base, now, quick_settings());
    found += row_of(comparison, "success_rate").verdict == Verdict::regression ? 1 : 0;
  }
  return static_cast<double>(found) / count;
}

TEST(ComparePower, FalseAlarmsAreBelowAlpha) {
  const double rate = false_alarm_rate(500);
  RecordProperty("false_alarm_rate", std::to_string(rate));
  EXPECT_LE(rate, 0.01);
}

TEST(ComparePower, ALossOfTenPointsIsFound) {
  EXPECT_GE(detection_rate(200, 0.0), 0.99);
  EXPECT_GE(detection_rate(200, 0.02), 0.9);
}

TEST(ComparePowerSlow, RatesOverManyComparisons) {
  const double alarms = false_alarm_rate(5000);
  std::cout << "false alarms: " << alarms << "\n";
  EXPECT_LE(alarms, 0.01);
  for (const double churn : {0.0, 0.01, 0.02, 0.03, 0.05}) {
    const double found = detection_rate(2000, churn);
    std::cout << "loss of 10 points, " << churn << " of chance each way: found " << found << "\n";
    if (churn <= 0.02) {
      EXPECT_GE(found, 0.9);
    }
  }
}

}  // namespace
}  // namespace avoidbench
