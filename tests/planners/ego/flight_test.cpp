#include <gtest/gtest.h>

#include "planners/support/trajectory_flight.hpp"
#include "planners/support/trajectory_suite.hpp"

namespace avoidbench::kinematic {
namespace {

const TrajectoryPlanner kEgo{.name = "ego",
                             .file = PLANNER_FILE,
                             .speed_limit_mps = 3.3,
                             .detour = 1.01,
                             .height_band_m = 0.1,
                             .published_speed_limit_mps = 2.2 * 1.42,  // along each axis
                             .is_random = false};

INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlight, testing::Values(kEgo), name_of);
INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlightSlow, testing::Values(kEgo), name_of);

/// An emergency stop may end far below the heights that it plans in.
TEST(Ego, ClimbsBackIntoItsHeights) {
  PlannerInstance planner = instance_of(PLANNER_FILE);
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
  PlannerInstance planner = instance_of(PLANNER_FILE);
  Course course = meadow();
  add_hedge(course, {-25.0, 15.0}, {25.0, 15.0});
  const TrajectoryResult result = fly_trajectories(planner, course, 25.0);
  EXPECT_EQ(result.flight.ending, Ending::timed_out) << result.flight.reason;
  expect_flyable(result.demands, kEgo.speed_limit_mps);
}

/// Planned for more speed than a horizon allows, curves were made slower as a whole, and it
/// crawled.
TEST(Ego, IsNotSlowerWithAHigherLimitOfSpeed) {
  const Course course = forest(5.0, 3);
  const auto time_s = [&](double limit_mps) {
    PlannerInstance planner =
        instance_of(PLANNER_FILE, {{"max_speed_mps", ParameterValue{limit_mps, ""}}});
    const TrajectoryResult result = fly_trajectories(planner, course);
    EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
    expect_flyable(result.demands, 1.1 * limit_mps);
    return result.flight.time_s;
  };
  const double at_4_s = time_s(4.0);
  EXPECT_LT(time_s(7.0), 1.1 * at_4_s);
  EXPECT_LT(time_s(10.0), 1.1 * at_4_s);
}

}  // namespace
}  // namespace avoidbench::kinematic
