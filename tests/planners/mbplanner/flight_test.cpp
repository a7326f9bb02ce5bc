#include <gtest/gtest.h>

#include <cmath>

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

TEST(Mbplanner, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

TEST(Mbplanner, HasNoPlanToNowhere) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::expect_no_plan_to_nowhere(planner);
}

constexpr double kSpeed_mps = 3.003;

TEST(Mbplanner, FliesNearlyStraightWhereNothingIsInTheWay) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const Course course = kinematic::meadow();
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course);
  ASSERT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  const double straight_m = (course.goal_world - course.start_world).norm() - 0.8;
  EXPECT_LT(result.flight.path_m, 1.03 * straight_m);
  EXPECT_LT(result.flight.time_s, straight_m / 2.5 + 2.0);
  EXPECT_GT(result.flight.lowest_m, 1.5);
  EXPECT_LT(result.flight.highest_m, 2.5);
  expect_flyable(result.demands, kSpeed_mps);
}

TEST(Mbplanner, ClearsSparseForestsAndMostDenseOnes) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  EXPECT_GE(reached_count(planner, 5.0, 6, kSpeed_mps), 6);
  EXPECT_GE(reached_count(planner, 2.8, 4, kSpeed_mps), 3);
}

TEST(Mbplanner, FindsTheGapInAWall) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-8.0, 15.0}, {2.0, 15.0});
  add_hedge(course, {4.5, 15.0}, {8.0, 15.0});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
}

/// Through a gap that only its tightest box fits in it creeps: a stop before it is free.
TEST(Mbplanner, SqueezesThroughANarrowGapSlowly) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-8.275, 15.0}, {-0.775, 15.0});
  add_hedge(course, {0.775, 15.0}, {8.275, 15.0});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  const std::vector<Eigen::Vector3d>& places = result.flight.positions;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const bool is_in_gap = std::abs(places[i].y() - 15.0) < 0.3 && std::abs(places[i].x()) < 0.8;
    const double speed_mps = 30.0 * (places[i] - places[i - 1]).norm();
    EXPECT_TRUE(!is_in_gap || speed_mps < 1.2) << speed_mps << " m/s at " << places[i].transpose();
  }
}

TEST(Mbplanner, GetsOutOfADeadEnd) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-3.0, 16.0}, {3.0, 16.0});
  add_hedge(course, {-3.0, 12.0}, {-3.0, 16.0});
  add_hedge(course, {3.0, 12.0}, {3.0, 16.0});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course, 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  EXPECT_LE(result.demands.speed_mps, 3.003);
}

TEST(Mbplanner, FliesThePublishedPreset) {
  PlannerInstance planner =
      kinematic::instance_of(PLANNER_FILE, {{"preset", ParameterValue{0.0, "published"}}});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, kinematic::meadow(), 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  expect_flyable(result.demands, 1.001);
}

TEST(Mbplanner, FliesASpeedThatIsGivenBesideThePublishedPreset) {
  PlannerInstance planner = kinematic::instance_of(
      PLANNER_FILE,
      {{"preset", ParameterValue{0.0, "published"}}, {"follower_speed_mps", {20.0, ""}}});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, kinematic::meadow(), 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  EXPECT_GT(result.demands.speed_mps, 1.5);  // the published limit is 1
}

TEST(Mbplanner, DoesNotGrowOverFiftyMissions) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::expect_no_growth(planner, 50);
}

TEST(MbplannerSlow, DoesNotGrowOverAThousandMissions) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::expect_no_growth(planner, 1000);
}

TEST(Mbplanner, FliesTheSameInSeveralThreads) { kinematic::expect_same_in_threads(PLANNER_FILE); }

TEST(Mbplanner, GivesTheSameFlightForTheSameSeedAlone) {
  const Course course = kinematic::forest(4.0, 3);
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const auto first = kinematic::fly_trajectories(planner, course, 6.0).flight.positions;
  const auto other = kinematic::fly_trajectories(planner, course, 6.0, 2).flight.positions;
  EXPECT_EQ(first, kinematic::fly_trajectories(planner, course, 6.0).flight.positions);
  EXPECT_NE(first, other);
}

}  // namespace
}  // namespace avoidbench
