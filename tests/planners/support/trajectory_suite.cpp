#include "planners/support/trajectory_suite.hpp"

#include "planners/support/conformance_expectation.hpp"
#include "planners/support/trajectory_flight.hpp"

namespace avoidbench::kinematic {
namespace {

constexpr double kGoalRadius_m = 0.8;  // the goal is reached this far before it
constexpr double kCruise_mps = 2.5;    // of limits of 3 m/s
constexpr double kAcceleration_s = 2.0;

TEST_P(TrajectoryFlight, KeepsEveryRule) { expect_conformance(GetParam().file); }

TEST_P(TrajectoryFlight, HasNoPlanToNowhere) {
  PlannerInstance planner = instance_of(GetParam().file);
  expect_no_plan_to_nowhere(planner);
}

TEST_P(TrajectoryFlight, FliesNearlyStraightWhereNothingIsInTheWay) {
  PlannerInstance planner = instance_of(GetParam().file);
  const Course course = meadow();
  const TrajectoryResult result = fly_trajectories(planner, course);
  ASSERT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  const double straight_m = (course.goal_world - course.start_world).norm() - kGoalRadius_m;
  EXPECT_LT(result.flight.path_m, GetParam().detour * straight_m);
  EXPECT_LT(result.flight.time_s, straight_m / kCruise_mps + kAcceleration_s);
  EXPECT_GT(result.flight.lowest_m, 2.0 - GetParam().height_band_m);
  EXPECT_LT(result.flight.highest_m, 2.0 + GetParam().height_band_m);
  expect_flyable(result.demands, GetParam().speed_limit_mps);
}

TEST_P(TrajectoryFlight, ClearsSparseForestsAndMostDenseOnes) {
  PlannerInstance planner = instance_of(GetParam().file);
  EXPECT_GE(reached_count(planner, 5.0, 6, GetParam().speed_limit_mps), 6);
  EXPECT_GE(reached_count(planner, 2.8, 4, GetParam().speed_limit_mps), 3);
}

TEST_P(TrajectoryFlight, FindsTheGapInAWall) {
  PlannerInstance planner = instance_of(GetParam().file);
  Course course = meadow();
  add_hedge(course, {-8.0, 15.0}, {2.0, 15.0});
  add_hedge(course, {4.5, 15.0}, {8.0, 15.0});
  const TrajectoryResult result = fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  expect_flyable(result.demands, GetParam().speed_limit_mps);
}

TEST_P(TrajectoryFlight, FliesThePublishedPreset) {
  PlannerInstance planner =
      instance_of(GetParam().file, {{"preset", ParameterValue{0.0, "published"}}});
  const TrajectoryResult result = fly_trajectories(planner, meadow(), 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  expect_flyable(result.demands, GetParam().published_speed_limit_mps);
}

TEST_P(TrajectoryFlight, GivesTheSameFlightAgain) {
  const Course course = forest(3.0, 3);
  PlannerInstance planner = instance_of(GetParam().file);
  const auto first = fly_trajectories(planner, course, 6.0).flight.positions;
  const auto other = fly_trajectories(planner, course, 6.0, 2).flight.positions;
  EXPECT_GT(first.size(), 100U);
  EXPECT_EQ(first, fly_trajectories(planner, course, 6.0).flight.positions);
  EXPECT_EQ(first != other, GetParam().is_random);
}

TEST_P(TrajectoryFlight, FliesTheSameInSeveralThreads) { expect_same_in_threads(GetParam().file); }

TEST_P(TrajectoryFlight, DoesNotGrowOverFiftyMissions) {
  PlannerInstance planner = instance_of(GetParam().file);
  expect_no_growth(planner, 50);
}

TEST_P(TrajectoryFlightSlow, DoesNotGrowOverAThousandMissions) {
  PlannerInstance planner = instance_of(GetParam().file);
  expect_no_growth(planner, 1000);
}

}  // namespace
}  // namespace avoidbench::kinematic
