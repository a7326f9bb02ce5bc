#include <gtest/gtest.h>

#include <cmath>

#include "base/digest.hpp"
#include "base/ticks.hpp"
#include "support/flight_worlds.hpp"
#include "support/planner_files.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"

/// Latency that is measured, and flown again from its records.
namespace avoidbench {
namespace {

TrialSpec measured_spec(const std::string& planner, double scale) {
  TrialSpec spec;
  spec.planner = test::preset_choice(planner);
  spec.latency = {.mode = LatencyMode::measured, .ms = 33.0, .scale = scale, .database = {}};
  return spec;
}

TrialRecord fly(const TrialSpec& spec, const std::vector<double>* recorded_s,
                const TrialObserver& observer = {}) {
  const World world = test::flight_world();
  const Scene scene(world);
  const PlannerLibrary library = PlannerLibrary::load(spec.planner.file);
  PlannerInstance planner(library, planner_setup(spec), parameter_values(spec.planner));
  return run_trial(spec, scene, test::straight_mission(), planner, observer, recorded_s);
}

TEST(MeasuredLatency, ABusyPlannerMissesCallsAndActsWhenItIsDone) {
  const TrialSpec spec = measured_spec("straight_line", 1.0);  // planned 30 times a second
  // Within the period; three periods exactly; a bit more than three; none at all from here on.
  const std::vector<double> recorded_s{0.01, 0.1, 0.101};
  std::vector<double> effects_s;
  TrialObserver observer;
  observer.planned = [&](const PlanStep& step) { effects_s.push_back(step.effect_s); };
  const TrialRecord record = fly(spec, &recorded_s, observer);
  EXPECT_EQ(record.outcome, Outcome::reached_goal) << record.reason;
  ASSERT_GT(record.plan_calls.size(), 6U);
  const double expected_s[] = {0.0, 1.0 / 30, 4.0 / 30, 8.0 / 30, 9.0 / 30};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(record.plan_calls[i].time_s, expected_s[i], 1e-9) << i;
    const double latency_s = i < recorded_s.size() ? recorded_s[i] : 0.0;
    EXPECT_EQ(record.plan_calls[i].latency_s, seconds(ticks(latency_s)));
    EXPECT_NEAR(effects_s[i], expected_s[i] + latency_s, 1e-9);
  }
}

TEST(MeasuredLatency, IsTheCallsWallTimeTimesTheScaleInWholeTicks) {
  const TrialSpec spec = measured_spec("straight_line", 1000.0);
  const TrialRecord record = fly(spec, nullptr);
  double longest_s = 0.0;
  for (const PlanCall& call : record.plan_calls) {
    EXPECT_EQ(call.latency_s, seconds(ticks(1000.0 * call.wall_time_s)));
    longest_s = std::max(longest_s, call.latency_s);
  }
  EXPECT_GT(longest_s, 0.0);
}

TEST(MeasuredLatency, IsNotRecordedWhereTheSpecSaysIt) {
  TrialSpec spec = measured_spec("straight_line", 1.0);
  spec.latency.mode = LatencyMode::fixed;
  const std::vector<double> ignored{1.0, 1.0};
  const TrialRecord record = fly(spec, &ignored);
  EXPECT_TRUE(std::isnan(record.plan_calls.front().latency_s));
  EXPECT_NEAR(record.plan_calls[1].time_s, 1.0 / 30, 1e-9);
}

TEST(MeasuredLatency, TheRecordedTimesGiveTheSameFlight) {
  const TrialSpec spec = measured_spec("reactive", 300.0);
  const TrialRecord first = fly(spec, nullptr);
  std::vector<double> recorded_s;
  for (const PlanCall& call : first.plan_calls) recorded_s.push_back(call.latency_s);
  TrialSpec again = spec;
  again.latency.mode = LatencyMode::replay;
  const TrialRecord second = fly(again, &recorded_s);
  ASSERT_EQ(first.samples.size(), second.samples.size());
  for (std::size_t i = 0; i < first.samples.size(); ++i) {
    ASSERT_EQ(first.samples[i].position_world, second.samples[i].position_world);
    ASSERT_EQ(first.samples[i].rates_body_radps, second.samples[i].rates_body_radps);
  }
  ASSERT_EQ(first.plan_calls.size(), second.plan_calls.size());
  for (std::size_t i = 0; i < recorded_s.size(); ++i) {
    EXPECT_EQ(second.plan_calls[i].latency_s, recorded_s[i]);
  }
}

/// Times of a machine make no golden table, but given times a flight of every machine's bits.
TEST(MeasuredLatency, FlightsOfGivenTimesAreThoseOfEveryMachine) {
  TrialSpec spec = measured_spec("straight_line", 1.0);
  spec.latency.mode = LatencyMode::replay;
  spec.odometry.position_sigma_m = 0.05;
  spec.odometry.velocity_sigma_mps = 0.1;
  spec.wind.mean_world_mps = {2.0, -1.0, 0.0};
  std::vector<double> recorded_s;
  for (int i = 0; i < 400; ++i) recorded_s.push_back(0.001 * (5 + i * 37 % 150));
  const TrialRecord record = fly(spec, &recorded_s);
  EXPECT_EQ(record.outcome, Outcome::reached_goal) << record.reason;
  Digest digest;
  for (const PlanCall& call : record.plan_calls) digest.add(call.time_s).add(call.latency_s);
  for (const Sample& sample : record.samples) {
    for (const double number : sample.position_world) digest.add(number);
    for (const double number : sample.rates_body_radps) digest.add(number);
  }
  EXPECT_EQ(digest.hex(), "4b1115f846d909632b84ef15928f2da89d97b00fde00b61ce8422bc7d6eb0537");
}

}  // namespace
}  // namespace avoidbench
