#include <gtest/gtest.h>

#include "planners/support/conformance_expectation.hpp"
#include "planners/support/trajectory_flight.hpp"

namespace avoidbench {
namespace {

using kinematic::add_hedge;
using kinematic::Course;
using kinematic::Ending;
using kinematic::expect_flyable;
using kinematic::reached_count;
using kinematic::TrajectoryResult;

constexpr double kSpeed_mps = 3.3;  // its limit and the tolerance of its feasibility check

TEST(Ego, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

TEST(Ego, HasNoPlanToNowhere) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::expect_no_plan_to_nowhere(planner);
}

TEST(Ego, FliesStraightWhereNothingIsInTheWay) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const Course course = kinematic::meadow();
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course);
  ASSERT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  const double straight_m = (course.goal_world - course.start_world).norm() - 0.8;
  EXPECT_LT(result.flight.path_m, 1.01 * straight_m);
  EXPECT_LT(result.flight.time_s, straight_m / 2.5 + 2.0);
  EXPECT_GT(result.flight.lowest_m, 1.9);
  EXPECT_LT(result.flight.highest_m, 2.1);
  expect_flyable(result.demands, kSpeed_mps);
}

TEST(Ego, ClearsSparseForestsAndMostDenseOnes) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  EXPECT_GE(reached_count(planner, 5.0, 6, kSpeed_mps), 6);
  EXPECT_GE(reached_count(planner, 2.8, 4, kSpeed_mps), 3);
}

TEST(Ego, FindsTheGapInAWall) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-8.0, 15.0}, {2.0, 15.0});
  add_hedge(course, {4.5, 15.0}, {8.0, 15.0});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  expect_flyable(result.demands, kSpeed_mps);
}

/// An emergency stop may end far below the heights that it plans in.
TEST(Ego, ClimbsBackIntoItsHeights) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  PlannerMission mission;
  mission.start_world = {0.0, 0.0, 2.0};
  mission.goal_world = {20.0, 0.0, 2.0};
  mission.goal_radius_m = 0.8;
  mission.time_limit_s = 60.0;
  ASSERT_EQ(planner.reset(mission), "");
  PlannerView view;
  view.position_world = {0.0, 0.0, -0.4};
  view.velocity_world.setZero();
  view.rates_body.setZero();
  view.q_world_body.setIdentity();
  double highest_m = view.position_world.z();
  for (int i = 0; i < 90; ++i) {
    view.time_s = i / 30.0;
    const PlanResult result = planner.plan(view);
    ASSERT_EQ(result.status, PlanStatus::command) << result.reason;
    for (const ab_point& point : result.points) {
      highest_m = std::max(highest_m, point.position_world_m[2]);
    }
  }
  EXPECT_GT(highest_m, 1.0);
}

TEST(Ego, StopsBeforeAWallWithoutAGapAndGoesOnTrying) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-25.0, 15.0}, {25.0, 15.0});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course, 25.0);
  EXPECT_EQ(result.flight.ending, Ending::timed_out) << result.flight.reason;
  expect_flyable(result.demands, kSpeed_mps);
}

TEST(Ego, FliesThePublishedPreset) {
  PlannerInstance planner =
      kinematic::instance_of(PLANNER_FILE, {{"preset", ParameterValue{0.0, "published"}}});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, kinematic::meadow());
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  expect_flyable(result.demands, 2.2);
}

TEST(Ego, FliesASpeedThatIsGivenBesideThePublishedPreset) {
  PlannerInstance planner = kinematic::instance_of(
      PLANNER_FILE, {{"preset", ParameterValue{0.0, "published"}}, {"max_speed_mps", {3.0, ""}}});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, kinematic::meadow());
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  EXPECT_GT(result.demands.speed_mps, 2.5);  // the published limit is 2
}

TEST(Ego, DoesNotGrowOverFiftyMissions) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::expect_no_growth(planner, 50);
}

TEST(EgoSlow, DoesNotGrowOverAThousandMissions) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::expect_no_growth(planner, 1000);
}

TEST(Ego, FliesTheSameInSeveralThreads) { kinematic::expect_same_in_threads(PLANNER_FILE); }

TEST(Ego, GivesTheSameFlightAgain) {
  const Course course = kinematic::forest(3.0, 3);
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const auto first = kinematic::fly_trajectories(planner, course, 6.0).flight.positions;
  EXPECT_EQ(first, kinematic::fly_trajectories(planner, course, 6.0).flight.positions);
}

}  // namespace
}  // namespace avoidbench
