#include "real_flights/judged_flight.hpp"

#include <gtest/gtest.h>

#include "metrics/flight_measures.hpp"
#include "support/flight_worlds.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

/// From (0, -15, 2) along y at 2 m/s, for `duration_s`.
RecordedMotion straight_motion(double duration_s, bool has_attitude = true) {
  std::vector<MeasuredPosition> measured;
  std::vector<MeasuredAttitude> attitudes;
  for (double t = 0.0; t <= duration_s + 1e-9; t += 0.02) {
    measured.push_back({t, Eigen::Vector3d(0.0, -15.0 + 2.0 * t, 2.0)});
    if (has_attitude) attitudes.push_back({t, yaw_rotation(0.5 * math::kPi)});
  }
  return {.path = SmoothPath(measured, {.position_noise_m = 0.001}),
          .attitudes = attitudes,
          .duration_s = measured.back().time_s};
}

TrialSpec spec_of(GivenOutcome outcome) {
  TrialSpec spec;
  spec.recording.emplace().outcome = outcome;
  return spec;
}

JudgedFlight judged(GivenOutcome outcome, double duration_s, const World& world,
                    bool has_attitude = true) {
  const Scene scene(world);
  return judge(spec_of(outcome), test::straight_mission(), scene,
               straight_motion(duration_s, has_attitude));
}

World with_pillar() {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({1.0F, 1.0F, 8.0F}), {0.0, 3.0, 4.0}, "pillar");
  return world;
}

TEST(JudgedFlight, EndsWhereItsPathEntersTheGoal) {
  const JudgedFlight flight = judged(GivenOutcome::judged, 20.0, test::flight_world());
  EXPECT_EQ(flight.problem, "");
  EXPECT_EQ(flight.record.outcome, Outcome::reached_goal);
  // 30 m less the radius of 0.8 m at 2 m/s, to the physics' millisecond.
  EXPECT_NEAR(flight.record.end_time_s, 29.2 / 2.0, 0.0015);
  EXPECT_NEAR(flown_length_m(flight.record.samples), 29.2, 0.01);
  EXPECT_NEAR(flight.record.samples.front().clearance_m, 1.94, 0.01);  // above the floor
  EXPECT_TRUE(std::isnan(flight.record.samples.front().rotor_power_w));
  EXPECT_LT(flight.record.samples[50].rates_body_radps.norm(), 1e-9);
}

TEST(JudgedFlight, CollidesWhereItsPathTouchesTheMap) {
  const JudgedFlight flight = judged(GivenOutcome::judged, 20.0, with_pillar());
  EXPECT_EQ(flight.record.outcome, Outcome::collided);
  // The body, 0.5 m square, is at the pillar's face at y = 2.5.
  EXPECT_NEAR(flight.record.end_time_s, (2.25 + 15.0) / 2.0, 0.01);
  ASSERT_EQ(flight.record.collisions.size(), 1U);
  EXPECT_EQ(flight.record.collisions[0].kind, "pillar");
  EXPECT_NEAR(flight.record.collisions[0].speed_mps, 2.0, 0.01);
}

TEST(JudgedFlight, BelievesWhatIsGiven) {
  // A scan's noise may touch a path that was flown.
  const JudgedFlight success = judged(GivenOutcome::reached_goal, 20.0, with_pillar());
  EXPECT_EQ(success.problem, "");
  EXPECT_EQ(success.record.outcome, Outcome::reached_goal);
  EXPECT_TRUE(success.record.collisions.empty());
  const JudgedFlight crash = judged(GivenOutcome::collided, 8.0, test::flight_world());
  EXPECT_EQ(crash.record.outcome, Outcome::collided);
  EXPECT_EQ(crash.record.end_time_s, 8.0);
  ASSERT_EQ(crash.record.collisions.size(), 1U);
  EXPECT_EQ(crash.record.collisions[0].obstacle, -1);
}

TEST(JudgedFlight, ReportsWhatContradictsThePath) {
  const JudgedFlight early = judged(GivenOutcome::reached_goal, 8.0, test::flight_world());
  EXPECT_TRUE(test::has(early.problem, "no nearer to the goal than 14.00 m")) << early.problem;
  const JudgedFlight late = judged(GivenOutcome::collided, 20.0, test::flight_world());
  EXPECT_TRUE(test::has(late.problem, "is given as collided, but its path reached the goal"))
      << late.problem;
}

TEST(JudgedFlight, OfALogThatEndsBeforeTheGoal) {
  const JudgedFlight flight = judged(GivenOutcome::judged, 8.0, test::flight_world());
  EXPECT_EQ(flight.record.outcome, Outcome::timed_out);
  EXPECT_TRUE(test::has(flight.record.reason, "the log ends after 8.00 s, 14.00 m"))
      << flight.record.reason;
}

/// Without attitudes: upright at a constant speed, heading along the path.
TEST(JudgedFlight, HeadsAlongItsPathWithoutAttitudes) {
  const JudgedFlight flight = judged(GivenOutcome::judged, 20.0, test::flight_world(), false);
  const Sample& sample = flight.record.samples[200];
  EXPECT_NEAR(yaw_of(sample.q_world_body), 0.5 * math::kPi, 1e-3);
  EXPECT_TRUE(sample.rates_body_radps.array().isNaN().all());
}

}  // namespace
}  // namespace avoidbench
