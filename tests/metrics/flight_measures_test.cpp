#include "metrics/flight_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "base/math.hpp"
#include "metrics/metric_table.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

Sample sample_at(double time_s, const Vector3d& position) {
  Sample sample;
  sample.time_s = time_s;
  sample.position_world = position;
  sample.velocity_world = sample.acceleration_world = sample.rates_body_radps = Vector3d::Zero();
  sample.reference_world = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  sample.q_world_body = Eigen::Quaterniond::Identity();
  return sample;
}

/// 2 m/s along x for 5 s.
std::vector<Sample> straight_flight() {
  std::vector<Sample> samples;
  for (int i = 0; i <= 500; ++i) {
    samples.push_back(sample_at(0.01 * i, Vector3d(0.02 * i, 0, 1)));
    samples.back().velocity_world = Vector3d(2, 0, 0);
    samples.back().clearance_m = 1.0 + 0.001 * i;
    samples.back().rotor_power_w = 50.0;
  }
  return samples;
}

/// A circle of 3 m radius at 1.5 m/s, once around.
std::vector<Sample> circular_flight(int rate_hz = 100) {
  std::vector<Sample> samples;
  const double period_s = math::kTau * 3.0 / 1.5;
  const auto add = [&](double time_s) {
    const double angle = math::kTau * time_s / period_s;
    const Vector3d out(math::cos(angle), math::sin(angle), 0.0);
    samples.push_back(sample_at(time_s, 3.0 * out));
    samples.back().acceleration_world = -0.75 * out;  // v²/r
  };
  for (int i = 0; i < period_s * rate_hz; ++i) add(static_cast<double>(i) / rate_hz);
  add(period_s);
  return samples;
}

TEST(FlightMeasures, OfAStraightFlight) {
  const auto samples = straight_flight();
  EXPECT_NEAR(flown_length_m(samples), 10.0, 1e-12);
  EXPECT_NEAR(mean_speed_mps(samples), 2.0, 1e-12);
  EXPECT_EQ(max_speed_mps(samples), 2.0);
  EXPECT_EQ(jerk_integral_mps2(samples), 0.0);
  EXPECT_NEAR(mean_curvature_1pm(samples), 0.0, 1e-12);
  EXPECT_EQ(min_clearance_m(samples), 1.0);
  EXPECT_NEAR(mean_clearance_m(samples), 1.25, 1e-9);
  EXPECT_NEAR(rotor_energy_j(samples), 250.0, 1e-9);
  EXPECT_TRUE(std::isnan(tracking_rmse_m(samples)));
}

TEST(FlightMeasures, OfACircle) {
  const auto samples = circular_flight();
  EXPECT_NEAR(flown_length_m(samples), math::kTau * 3.0, 1e-4);
  EXPECT_NEAR(mean_curvature_1pm(samples), 1.0 / 3.0, 1e-4);
  // |a| = v²/r all the way; |jerk| = v³/r² all the way.
  EXPECT_NEAR(acceleration_effort(samples), 0.75 * 0.75 / 1.5, 1e-4);
  // Less what follows the last whole 20 ms.
  EXPECT_NEAR(jerk_integral_mps2(samples), 0.75 * math::kTau, 0.02 * 0.375);
  EXPECT_NEAR(jerk_effort(samples), 0.375 * 0.375 / 1.5, 2e-4);
}

TEST(FlightMeasures, JerksOfACircleAreItsChords) {
  // 63 Hz, and the moments of 50 Hz too, as flights are sampled at such a rate: the acceleration
  // turns by v/r · 20 ms between these, along a chord of 2 v²/r sin(v/r · 10 ms).
  constexpr double kEnd_s = 4.0, kTurn_radps = 0.5;
  std::set<int> ticks;
  for (int tick = 0; tick <= 36000 * kEnd_s; tick += 36000 / 63) ticks.insert(tick);
  std::vector<Sample> between;
  const auto sampled = [&] {
    std::vector<Sample> samples;
    for (const int tick : ticks) {
      const double time_s = tick / 36000.0, angle = kTurn_radps * time_s;
      samples.push_back(sample_at(time_s, 3.0 * Vector3d(math::cos(angle), math::sin(angle), 0)));
      samples.back().acceleration_world = -0.25 * samples.back().position_world;
    }
    return samples;
  };
  // Without them it is not guessed.
  EXPECT_TRUE(std::isnan(jerk_integral_mps2(sampled())));
  for (int tick = 0; tick <= 36000 * kEnd_s; tick += 720) ticks.insert(tick);
  const double chord_mps2 = 2.0 * 0.75 * std::sin(kTurn_radps * 0.01);
  EXPECT_NEAR(jerk_integral_mps2(sampled()), 200.0 * chord_mps2, 1e-10);
  EXPECT_NEAR(jerk_effort(sampled()) * flown_length_m(sampled()),
              200.0 * 50.0 * chord_mps2 * chord_mps2, 1e-10);
}

TEST(FlightMeasures, ResamplingInTimeKeepsThem) {
  const auto fine = circular_flight(400), coarse = circular_flight(100);
  EXPECT_NEAR(flown_length_m(coarse), flown_length_m(fine), 1e-3);
  EXPECT_NEAR(jerk_integral_mps2(coarse), jerk_integral_mps2(fine), 1e-3);
  EXPECT_NEAR(mean_curvature_1pm(coarse), mean_curvature_1pm(fine), 1e-3);
}

/// Three seconds and a bit of flight with rotors' ripple on the acceleration, sampled at a rate
/// and, as flights are, at 50 Hz where that is less.
std::vector<Sample> rippled_flight(int rate_hz, double ripple_mps2) {
  constexpr int kTicksASecond = 36000, kEnd = 3 * kTicksASecond + 345;
  std::vector<Sample> samples;
  const auto add = [&](int tick) {
    const double time_s = static_cast<double>(tick) / kTicksASecond;
    samples.push_back(sample_at(time_s, Vector3d(2.0 * time_s, 0, 1)));
    samples.back().acceleration_world =
        Vector3d(3.0 * math::sin(2.0 * time_s), math::cos(3.0 * time_s),
                 ripple_mps2 * math::sin(math::kTau * 137.0 * time_s));
  };
  for (int tick = 0; tick < kEnd; ++tick) {
    const bool is_of_jerks = rate_hz > 50 && tick % (kTicksASecond / 50) == 0;
    if (tick % (kTicksASecond / rate_hz) == 0 || is_of_jerks) add(tick);
  }
  add(kEnd);
  return samples;
}

TEST(FlightMeasures, JerksAreThoseOfOneRateWhateverTheSamples) {
  const auto at_50_hz = rippled_flight(50, 0.8);
  EXPECT_GT(jerk_integral_mps2(at_50_hz), 50.0);  // the ripple's, not the flight's
  for (const int rate_hz : {60, 90, 100, 120, 200, 250, 500, 1000}) {
    const auto samples = rippled_flight(rate_hz, 0.8);
    EXPECT_EQ(jerk_integral_mps2(samples), jerk_integral_mps2(at_50_hz)) << rate_hz;
    EXPECT_NEAR(jerk_effort(samples), jerk_effort(at_50_hz), 1e-9 * jerk_effort(at_50_hz));
  }
}

TEST(FlightMeasures, JerksAreNoneBelowTheirRate) {
  for (const int rate_hz : {10, 25, 48}) {
    EXPECT_TRUE(std::isnan(jerk_integral_mps2(rippled_flight(rate_hz, 0.0)))) << rate_hz;
    EXPECT_TRUE(std::isnan(jerk_effort(rippled_flight(rate_hz, 0.0)))) << rate_hz;
  }
}

TEST(FlightMeasures, TrackingErrorOverSamplesWithAReference) {
  auto samples = straight_flight();
  samples[10].reference_world = samples[10].position_world + Vector3d(0.3, 0, 0);
  samples[20].reference_world = samples[20].position_world + Vector3d(0, 0.4, 0);
  EXPECT_NEAR(tracking_rmse_m(samples), std::sqrt((0.09 + 0.16) / 2.0), 1e-12);
}

TEST(FlightMeasures, OfNothingAreZero) {
  EXPECT_EQ(flown_length_m({}), 0.0);
  EXPECT_EQ(mean_speed_mps({}), 0.0);
  EXPECT_EQ(mean_curvature_1pm({sample_at(0, Vector3d::Zero())}), 0.0);
}

TEST(Progress, IsTheProjectionOnTheCourse) {
  const Vector3d start(0, 0, 2), goal(0, 30, 2);
  EXPECT_NEAR(progress_pct(start, goal, goal), 100.0, 1e-12);
  EXPECT_NEAR(progress_pct(start, goal, start), 0.0, 1e-12);
  EXPECT_NEAR(progress_pct(start, goal, {5, 15, 2}), 50.0, 1e-12);
  EXPECT_NEAR(progress_pct(start, goal, {0, 33, 2}), 90.0,
              1e-12);  // past the goal counts as short of it
  EXPECT_LT(progress_pct(start, goal, {0, -3, 2}), 0.0);
}

MissionRecord straight_mission() {
  MissionRecord mission;
  mission.mission.goal_world = {10, 0, 1};
  mission.mission.start_world = {0, 0, 1};
  mission.reference_length_m = 8.0;
  return mission;
}

double value_of(const std::string& name, const std::vector<double>& values) {
  const auto table = metric_table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].name == name) return values[i];
  }
  ADD_FAILURE() << name;
  return 0.0;
}

TEST(MetricTable, OfAFinishedFlight) {
  TrialRecord record;
  record.outcome = Outcome::reached_goal;
  record.samples = straight_flight();
  record.end_time_s = 5.0;
  for (int i = 1; i <= 100; ++i)
    record.plan_calls.push_back({.time_s = 0.0, .cpu_time_s = 1e-3 * i, .wall_time_s = 2e-3 * i});
  record.plan_calls[3].status = 1;
  const auto values = compute_metrics({TrialSpec{}, straight_mission(), record});
  EXPECT_EQ(value_of("finished", values), 1.0);
  EXPECT_NEAR(value_of("path_optimality_pct", values), 25.0, 1e-9);
  EXPECT_NEAR(value_of("average_goal_velocity_mps", values), 1.6, 1e-12);
  EXPECT_EQ(value_of("mission_progress_pct", values), 100.0);
  EXPECT_NEAR(value_of("processing_time_ms", values), 50.5, 1e-9);
  EXPECT_NEAR(value_of("processing_time_p50_ms", values), 50.5, 1e-9);
  EXPECT_NEAR(value_of("processing_time_p95_ms", values), 95.05, 1e-9);
  EXPECT_NEAR(value_of("processing_time_max_ms", values), 100.0, 1e-9);
  EXPECT_NEAR(value_of("processing_time_std_ms", values), std::sqrt(100.0 * 101.0 / 12.0), 1e-9);
  EXPECT_EQ(value_of("no_plan_count", values), 1.0);
  EXPECT_NEAR(value_of("processing_wall_time_ms", values), 101.0, 1e-9);
  EXPECT_EQ(value_of("deadline_miss_count", values), 84.0);  // wall: 34 ms and more at 30 Hz
  EXPECT_EQ(value_of("relative_end_distance_ratio", values), 0.0);
}

TEST(MetricTable, FailuresAreLeftOutOfFinishedMetricsOnly) {
  TrialRecord record;
  record.outcome = Outcome::collided;
  record.samples = straight_flight();
  record.samples.resize(251);  // at x = 5 m
  record.end_time_s = 2.5;
  record.collisions.push_back({.time_s = 2.5, .speed_mps = 2.0, .obstacle = 1, .kind = "tree"});
  const auto values = compute_metrics({TrialSpec{}, straight_mission(), record});
  EXPECT_EQ(value_of("finished", values), 0.0);
  EXPECT_TRUE(std::isnan(value_of("path_optimality_pct", values)));
  EXPECT_TRUE(std::isnan(value_of("energy_optimality", values)));
  EXPECT_NEAR(value_of("mission_progress_pct", values), 50.0, 1e-9);
  EXPECT_NEAR(value_of("relative_end_distance_ratio", values), 0.5, 1e-9);
  EXPECT_EQ(value_of("collision_count", values), 1.0);
  EXPECT_NEAR(value_of("path_length_m", values), 5.0, 1e-12);
}

TEST(MetricTable, CollisionsAreAllCountedAndTheFirstHasTheSpeed) {
  TrialRecord record;
  record.outcome = Outcome::reached_goal;
  record.samples = straight_flight();
  record.end_time_s = 5.0;
  EXPECT_TRUE(std::isnan(
      value_of("collision_speed_mps", compute_metrics({TrialSpec{}, straight_mission(), record}))));
  record.collisions.push_back({.time_s = 1.5, .speed_mps = 2.0, .obstacle = 1, .kind = "tree"});
  record.collisions.push_back({.time_s = 3.5, .speed_mps = 0.7, .obstacle = 2, .kind = "wall"});
  const auto values = compute_metrics({TrialSpec{}, straight_mission(), record});
  EXPECT_EQ(value_of("collision_speed_mps", values), 2.0);
  EXPECT_EQ(value_of("collision_count", values), 2.0);
}

TEST(MetricTable, OfATrialThatNeverFlew) {
  TrialRecord record;
  record.outcome = Outcome::planner_crashed;
  const auto values = compute_metrics({TrialSpec{}, straight_mission(), record});
  EXPECT_EQ(value_of("finished", values), 0.0);
  EXPECT_NEAR(value_of("mission_progress_pct", values), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(value_of("processing_time_ms", values)));
}

TEST(MetricTable, NamesAreUniqueColumnsWithDocs) {
  std::set<std::string> names;
  for (const MetricDef& metric : metric_table()) {
    EXPECT_TRUE(names.emplace(metric.name).second) << metric.name;
    EXPECT_EQ(metric.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
              std::string_view::npos);
    EXPECT_FALSE(metric.doc.empty());
    EXPECT_FALSE(metric.formula.empty());
    EXPECT_GE(metric.version, 1);
  }
  EXPECT_GT(names.size(), 10U);
}

}  // namespace
}  // namespace avoidbench
