#include "trial/run_trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "support/flight_worlds.hpp"
#include "support/planner_files.hpp"
#include "trial/planner_view.hpp"
#include "trial/preset_flight.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// A trial with one of the deliberately bad planners, which have no parameters.
TrialRecord fly_bad(const std::string& name) {
  TrialSpec spec;
  spec.planner.file = std::string(BAD_PLANNERS) + "/" + name + ".so";
  return fly(spec, test::flight_world(), test::straight_mission());
}

TEST(RunTrial, ReachesTheGoalInAnEmptyWorld) {
  const TrialRecord record =
      fly(spec_of("straight_line"), test::flight_world(), test::straight_mission());
  EXPECT_EQ(record.outcome, Outcome::reached_goal) << record.reason;
  const Vector3d& end = record.samples.back().position_world;
  EXPECT_NEAR((Vector3d(0, 15, 2) - end).head<2>().norm(), 0.8,
              0.01);  // stops at the radius, not beyond
  EXPECT_NEAR(end.x(), 0.0, 0.02);
  EXPECT_NEAR(record.samples.front().position_world.y(), -15.0, 1e-12);
  EXPECT_TRUE(record.collisions.empty());
}

TEST(RunTrial, EverySensorShowsWhatAPlannerMayAskFor) {
  for (SensorSpec sensor : sensor_presets()) {
    if (rig_cameras(sensor).empty()) continue;  // see lidar_sensing_test.cpp
    sensor.width_px = 80;
    sensor.height_px = 48;
    if (auto* sgm = std::get_if<StereoSgbmSpec>(&sensor.method)) sgm->disparities = 32;
    if (auto* census = std::get_if<StereoSgmSpec>(&sensor.method)) census->disparities = 32;
    TrialSpec spec;
    spec.sensor = sensor;
    spec.odometry.position_drift_ratio = 0.001;
    spec.planner.file = std::string(BAD_PLANNERS) + "/sees_all.so";
    Mission mission = test::straight_mission();
    mission.goal_world.y() = mission.start_world.y() + 4.0;
    const TrialRecord record = fly(spec, test::flight_world(), mission);
    EXPECT_EQ(record.outcome, Outcome::reached_goal) << sensor.name << ": " << record.reason;
    const TrialRecord again = fly(spec, test::flight_world(), mission);
    ASSERT_EQ(record.samples.size(), again.samples.size());
    EXPECT_EQ(record.samples.back().position_world, again.samples.back().position_world);
  }
}

TEST(RunTrial, ADriftedVehicleReachesWhatItTakesForTheGoal) {
  TrialSpec spec = spec_of("straight_line");
  spec.odometry.yaw_drift_deg_per_sqrt_s = 2.0;
  spec.mission.time_limit_s = 30.0;
  const TrialRecord exact =
      fly(spec_of("straight_line"), test::flight_world(), test::straight_mission());
  const TrialRecord drifted = fly(spec, test::flight_world(), test::straight_mission());
  const auto aside = [](const TrialRecord& record) {
    double most = 0.0;
    for (const Sample& sample : record.samples) {
      most = std::max(most, std::abs(sample.position_world.x()));
    }
    return most;
  };
  EXPECT_LT(aside(exact), 0.05);
  EXPECT_GT(aside(drifted), 0.15);  // it flies straight in its own frame
}

TEST(RunTrial, AnObserverChangesNothing) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({2, 1, 8}), {0, 0, 2}, "wall");
  const Scene scene(world);
  const TrialSpec spec = spec_of("reactive");
  const PlannerLibrary library = PlannerLibrary::load(spec.planner.file);
  PlannerInstance planner(library, planner_setup(spec), parameter_values(spec.planner));
  const Mission mission = test::straight_mission();
  const TrialRecord alone = run_trial(spec, scene, mission, planner);
  EXPECT_TRUE(planner.take_drawings().empty());
  planner.want_drawings(true);
  std::vector<double> times;
  std::size_t images = 0, drawings = 0;
  TrialObserver observer;
  observer.planned = [&](const PlanStep& step) {
    times.push_back(step.time_s);
    EXPECT_NEAR(step.effect_s, step.time_s + 0.033, 1e-4);
    EXPECT_EQ(step.truth.position_world, step.believed.position_world);
    EXPECT_EQ(step.result.status, PlanStatus::command);
    images += step.view.depth.size();
    drawings += step.drawings.size();
  };
  const TrialRecord watched = run_trial(spec, scene, mission, planner, observer);
  EXPECT_EQ(watched.outcome, alone.outcome);
  EXPECT_EQ(watched.end_time_s, alone.end_time_s);
  ASSERT_EQ(watched.samples.size(), alone.samples.size());
  for (std::size_t i = 0; i < alone.samples.size(); ++i) {
    ASSERT_EQ(watched.samples[i].position_world, alone.samples[i].position_world);
    ASSERT_EQ(watched.samples[i].q_world_body.coeffs(), alone.samples[i].q_world_body.coeffs());
    ASSERT_EQ(watched.samples[i].rotor_power_w, alone.samples[i].rotor_power_w);
  }
  ASSERT_EQ(times.size(), watched.plan_calls.size());
  EXPECT_EQ(times.back(), watched.plan_calls.back().time_s);
  EXPECT_EQ(images, times.size());
  EXPECT_GT(drawings, times.size());
}

TEST(RunTrial, SamplesAtAHundredHertzAndPlansAtThirty) {
  const TrialRecord record =
      fly(spec_of("straight_line"), test::flight_world(), test::straight_mission());
  for (std::size_t i = 0; i + 1 < record.samples.size(); ++i) {
    ASSERT_DOUBLE_EQ(record.samples[i].time_s, 0.01 * static_cast<double>(i));
  }
  EXPECT_DOUBLE_EQ(record.samples.back().time_s, record.end_time_s);
  for (std::size_t i = 0; i < record.plan_calls.size(); ++i) {
    ASSERT_DOUBLE_EQ(record.plan_calls[i].time_s, static_cast<double>(i) / 30.0);
    ASSERT_GE(record.plan_calls[i].wall_time_s, 0.0);
  }
  EXPECT_EQ(record.plan_calls.size(), static_cast<std::size_t>(record.end_time_s * 30.0) + 1);
}

TEST(RunTrial, IsSampledAtTheMomentsOfJerksToo) {
  const auto flown_at = [](double sample_hz) {
    TrialSpec spec = spec_of("straight_line");
    spec.rates.sample_hz = sample_hz;
    return fly(spec, test::flight_world(), test::straight_mission());
  };
  const TrialRecord plain = flown_at(100.0);
  const auto acceleration_at = [](const TrialRecord& record, double time_s) {
    const auto found =
        std::find_if(record.samples.begin(), record.samples.end(),
                     [&](const Sample& sample) { return std::abs(sample.time_s - time_s) < 1e-9; });
    return found == record.samples.end()
               ? Vector3d(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()))
               : found->acceleration_world;
  };
  for (const double sample_hz : {60.0, 75.0, 120.0}) {
    const TrialRecord record = flown_at(sample_hz);
    for (int i = 0; i < 100; ++i) {
      // Steps are split at other moments: not the same bits.
      const Vector3d acceleration = acceleration_at(record, 0.02 * i);
      ASSERT_LT((acceleration - acceleration_at(plain, 0.02 * i)).norm(), 0.02)
          << sample_hz << " Hz, " << 0.02 * i << " s";
      ASSERT_TRUE(acceleration_at(record, i / sample_hz).allFinite());
    }
  }
  // Below, and at its multiples, the rate is that of the samples alone.
  EXPECT_EQ(flown_at(40.0).samples.size(),
            static_cast<std::size_t>(flown_at(40.0).end_time_s * 40.0) + 2);
}

TEST(RunTrial, CollidesWhereTheBoxFirstTouchesTheWall) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({10, 1, 8}), {0, 0, 2}, "wall");
  const TrialRecord record = fly(spec_of("straight_line"), world, test::straight_mission());
  ASSERT_EQ(record.outcome, Outcome::collided);
  ASSERT_EQ(record.collisions.size(), 1U);
  EXPECT_EQ(record.collisions[0].kind, "wall");
  EXPECT_GT(record.collisions[0].speed_mps, 1.0);
  // Nose 0.25 m ahead of the centre, less what the pitch takes; the wall's face is at y = -0.5 m.
  EXPECT_NEAR(record.samples.back().position_world.y(), -0.75, 0.02);
  EXPECT_EQ(record.samples.back().clearance_m, 0.0);
}

TEST(RunTrial, SurvivesAsManyCollisionsAsAllowed) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({10, 0.1F, 8}), {0, -5, 2}, "wall");
  test::add_obstacle(world, test::box_mesh({10, 0.1F, 8}), {0, 5, 2}, "wall");
  TrialSpec spec = spec_of("straight_line");
  spec.mission.max_collisions = 1;
  const TrialRecord record = fly(spec, world, test::straight_mission());
  EXPECT_EQ(record.outcome, Outcome::collided);
  ASSERT_EQ(record.collisions.size(), 2U);
  EXPECT_EQ(record.collisions[0].obstacle, 1);
  EXPECT_EQ(record.collisions[1].obstacle, 2);
}

TEST(RunTrial, EndsAtTheBoundsAndAtTheTimeLimit) {
  World world = test::flight_world();
  world.bounds.max().y() = 5.0;
  EXPECT_EQ(fly(spec_of("straight_line"), world, test::straight_mission()).outcome,
            Outcome::left_bounds);
  TrialSpec spec = spec_of("straight_line");
  spec.mission.time_limit_s = 2.0;
  const TrialRecord late = fly(spec, test::flight_world(), test::straight_mission());
  EXPECT_EQ(late.outcome, Outcome::timed_out);
  EXPECT_DOUBLE_EQ(late.end_time_s, 2.0);
}

TEST(RunTrial, APlannersFailureIsAnOutcomeWithItsReason) {
  const TrialRecord nan = fly_bad("nan_command");
  EXPECT_EQ(nan.outcome, Outcome::planner_error);
  EXPECT_NE(nan.reason.find("finite"), std::string::npos) << nan.reason;
  const TrialRecord undeclared = fly_bad("undeclared_kind");
  EXPECT_EQ(undeclared.outcome, Outcome::planner_error);
  EXPECT_FALSE(undeclared.reason.empty());
}

TEST(RunTrial, LatencyDelaysWhatIsSeenFirst) {
  TrialSpec spec = spec_of("straight_line");
  spec.latency.ms = 200.0;  // fixed
  const TrialRecord late = fly(spec, test::flight_world(), test::straight_mission());
  spec.latency.mode = LatencyMode::zero;
  const TrialRecord prompt = fly(spec, test::flight_world(), test::straight_mission());
  EXPECT_LT(late.samples[20].velocity_world.norm(), 1e-6);  // 0.20 s: the first command acts now
  EXPECT_GT(late.samples[40].velocity_world.norm(), 0.01);
  EXPECT_GT(prompt.samples[20].velocity_world.norm(), 0.01);
}

TEST(RunTrial, ReactiveFliesAroundABoxThatStopsStraightLine) {
  World world = test::flight_world();
  test::add_obstacle(world, test::cylinder_mesh(0.5, 8.0, 24), {0, 0, 0}, "cylinder");
  EXPECT_EQ(fly(spec_of("straight_line"), world, test::straight_mission()).outcome,
            Outcome::collided);
  const TrialRecord around = fly(spec_of("reactive"), world, test::straight_mission());
  EXPECT_EQ(around.outcome, Outcome::reached_goal) << around.reason;
}

TEST(RunTrial, TwiceTheSameBits) {
  World world = test::flight_world();
  test::add_obstacle(world, test::cylinder_mesh(0.5, 8.0, 24), {0.2, 0, 0}, "cylinder");
  const TrialRecord first = fly(spec_of("reactive"), world, test::straight_mission());
  const TrialRecord second = fly(spec_of("reactive"), world, test::straight_mission());
  ASSERT_EQ(first.samples.size(), second.samples.size());
  for (std::size_t i = 0; i < first.samples.size(); ++i) {
    ASSERT_EQ(first.samples[i].position_world, second.samples[i].position_world);
    ASSERT_EQ(first.samples[i].acceleration_world, second.samples[i].acceleration_world);
  }
}

TEST(RunTrial, FollowsATranslatedWorld) {
  const Vector3d shift(2.0, 1.0, 0.5);
  Mission moved = test::straight_mission();
  moved.start_world += shift;
  moved.goal_world += shift;
  const TrialRecord here =
      fly(spec_of("straight_line"), test::flight_world(), test::straight_mission());
  const TrialRecord there = fly(spec_of("straight_line"), test::flight_world(), moved);
  ASSERT_EQ(here.samples.size(), there.samples.size());
  for (std::size_t i = 0; i < here.samples.size(); ++i) {
    const Vector3d difference =
        there.samples[i].position_world - here.samples[i].position_world - shift;
    ASSERT_LT(difference.norm(), 1e-9);
  }
}

TEST(MakeMission, IsFreeAroundAndTheSameForTheSameIndex) {
  World world = test::flight_world();
  for (int i = -2; i <= 2; ++i) {
    test::add_obstacle(world, test::cylinder_mesh(0.4, 8.0, 12), {2.2 * i, -16, 0}, "cylinder");
  }
  const Scene scene(world);
  const MissionSpec rules{.free_radius_m = 1.0};
  for (std::int64_t index = 0; index < 20; ++index) {
    const auto mission = make_mission(scene, rules, 3, index);
    ASSERT_TRUE(mission.has_value());
    EXPECT_GE(scene.nearest(mission->start_world).distance_m, 1.0);
    EXPECT_EQ(mission->start_world, make_mission(scene, rules, 3, index)->start_world);
    EXPECT_NE(mission->start_world, make_mission(scene, rules, 4, index)->start_world);
  }
  EXPECT_FALSE(
      make_mission(scene, {.free_radius_m = 3.0}, 3, 0).has_value());  // the floor is 2 m below
}

/// The goal is behind a gate that a box closes and opens: the same straight flight meets it or not.
TEST(RunTrial, MovingObstaclesAreMetWhereTheyAreAtThatTime) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({1, 1, 8}), {0, 0, 2}, "slider");
  const auto flown = [&](double amplitude_m, double phase) {
    World moving = world;
    moving.motions = {
        {.instance = 1,
         .path = Sway{.amplitude_world = {amplitude_m, 0, 0}, .period_s = 1000.0, .phase = phase}}};
    return fly(spec_of("straight_line"), moving, test::straight_mission());
  };
  const TrialRecord met = flown(3.0, 0.0);  // hardly out of the way within the flight
  ASSERT_EQ(met.outcome, Outcome::collided) << met.reason;
  EXPECT_EQ(met.collisions[0].kind, "slider");
  EXPECT_NEAR(met.samples.back().position_world.y(), -0.75, 0.02);
  EXPECT_EQ(flown(3.0, 0.25).outcome, Outcome::reached_goal);  // 3 m aside all the time
}

/// A hovering vehicle is hit by what comes to it, at the time that follows from the motion.
TEST(RunTrial, AHoveringVehicleIsHitByWhatComes) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({1, 6, 8}), {-6, -15, 2}, "slider");
  world.motions = {
      {.instance = 1, .path = Sway{.amplitude_world = {12, 0, 0}, .period_s = 40.0, .phase = 0.0}}};
  TrialSpec spec = spec_of("straight_line");
  Mission mission = test::straight_mission();
  mission.goal_world = mission.start_world + Vector3d(0, 1.0, 0);  // stays about where it is
  spec.mission.goal_radius_m = 0.0;                                // never reached
  spec.mission.time_limit_s = 20.0;
  const TrialRecord record = fly(spec, world, mission);
  ASSERT_EQ(record.outcome, Outcome::collided) << record.reason;
  // Its face comes to the vehicle's side: -6 + 12 sin(2πt/40) + 0.5 = -0.25.
  const double expected_s = 40.0 / math::kTau * std::asin(5.25 / 12.0);
  EXPECT_NEAR(record.end_time_s, expected_s, 0.1);
  EXPECT_EQ(record.collisions[0].kind, "slider");
}

}  // namespace
}  // namespace avoidbench
