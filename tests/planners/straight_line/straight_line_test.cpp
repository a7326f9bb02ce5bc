#include <gtest/gtest.h>

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

}  // namespace
}  // namespace avoidbench
