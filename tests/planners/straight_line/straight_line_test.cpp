#include <gtest/gtest.h>

#include "base/math.hpp"
#include "planners/support/conformance_expectation.hpp"
#include "planners/support/kinematic_flight.hpp"

namespace avoidbench {
namespace {

TEST(StraightLine, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

TEST(StraightLine, FliesTheLineAtItsSpeed) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::Course course = kinematic::meadow();
  course.goal_world = {12.0, 30.0, 4.0};
  const kinematic::Result flight = kinematic::fly(planner, course);
  ASSERT_EQ(flight.ending, kinematic::Ending::reached_goal);
  const Eigen::Vector3d way = course.goal_world - course.start_world;
  for (const Eigen::Vector3d& position : flight.positions) {
    EXPECT_LT((position - course.start_world).cross(way.normalized()).norm(), 1e-9);
  }
  // 3 m/s, less the lag at either end.
  EXPECT_NEAR(flight.time_s, way.norm() / 3.0, 1.0);
}

TEST(StraightLine, FliesIntoWhatIsInTheWay) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::Course course = kinematic::meadow();
  course.cylinders.push_back({{0.0, 20.0}, 0.3});
  EXPECT_EQ(kinematic::fly(planner, course).ending, kinematic::Ending::collided);
}

TEST(StraightLine, ComesBackToTheLine) {
  const PlannerLibrary library = PlannerLibrary::load(PLANNER_FILE);
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  PlannerMission mission;
  mission.goal_world = {20.0, 0.0, 2.0};
  mission.start_world = {0.0, 0.0, 2.0};
  ASSERT_EQ(planner.reset(mission), "");
  PlannerView beside;
  beside.position_world = {5.0, 1.0, 2.5};
  beside.velocity_world.setZero();
  beside.rates_body.setZero();
  beside.q_world_body.setIdentity();
  const PlanResult plan = planner.plan(beside);
  ASSERT_EQ(plan.status, PlanStatus::command);
  EXPECT_DOUBLE_EQ(plan.command.velocity_world_mps[0], 3.0);
  EXPECT_DOUBLE_EQ(plan.command.velocity_world_mps[1], -1.0);
  EXPECT_DOUBLE_EQ(plan.command.velocity_world_mps[2], -0.5);
  EXPECT_EQ(plan.command.yaw_rad, 0.0);
}

/// From (1, 2, 3), with 0.3 rad at the start.
struct FromAPlace : testing::Test {
  /// The command of a vehicle that is so far from the start.
  ab_command command_to(const Eigen::Vector3d& goal_world, const Eigen::Vector3d& aside_m) {
    PlannerMission mission;
    mission.start_world = {1.0, 2.0, 3.0};
    mission.start_yaw_rad = 0.3;
    mission.goal_world = goal_world;
    EXPECT_EQ(planner.reset(mission), "");
    PlannerView view;
    view.position_world = mission.start_world + aside_m;
    view.velocity_world = view.rates_body = Eigen::Vector3d::Zero();
    view.q_world_body.setIdentity();
    const PlanResult plan = planner.plan(view);
    EXPECT_EQ(plan.status, PlanStatus::command) << plan.reason;
    return plan.command;
  }
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
};

TEST_F(FromAPlace, LooksAlongTheCourseWhereThatHasAHeading) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  EXPECT_EQ(command_to({9.0, 2.0, 3.0}, none).yaw_rad, 0.0);
  EXPECT_NEAR(command_to({1.0, 9.0, 3.0}, none).yaw_rad, 0.5 * math::kPi, 1e-12);
  EXPECT_NEAR(command_to({-4.0, -3.0, 3.0}, none).yaw_rad, -0.75 * math::kPi, 1e-12);
  EXPECT_EQ(command_to({1.0, 2.0, 9.0}, none).yaw_rad, 0.3);  // straight up: as at the start
}

TEST_F(FromAPlace, WhereTheStartIsTheGoalItGoesBackThere) {
  const ab_command command = command_to({1.0, 2.0, 3.0}, {0.5, -0.25, 0.125});
  EXPECT_DOUBLE_EQ(command.velocity_world_mps[0], -0.5);
  EXPECT_DOUBLE_EQ(command.velocity_world_mps[1], 0.25);
  EXPECT_DOUBLE_EQ(command.velocity_world_mps[2], -0.125);
  EXPECT_EQ(command.yaw_rad, 0.3);
}

/// Twice the way that is left a second, however near, and back where it flew past.
TEST_F(FromAPlace, SlowsDownToTheGoalAndComesBackFromBeyondIt) {
  EXPECT_NEAR(command_to({5.0, 2.0, 3.0}, {3.99, 0.0, 0.0}).velocity_world_mps[0], 0.02, 1e-12);
  EXPECT_NEAR(command_to({5.0, 2.0, 3.0}, {4.02, 0.0, 0.0}).velocity_world_mps[0], -0.04, 1e-12);
}

}  // namespace
}  // namespace avoidbench
