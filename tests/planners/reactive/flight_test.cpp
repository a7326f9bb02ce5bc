#include <gtest/gtest.h>

#include "planners/support/conformance_expectation.hpp"
#include "planners/support/kinematic_flight.hpp"

namespace avoidbench {
namespace {

using kinematic::add_hedge;
using kinematic::Course;
using kinematic::Ending;
using kinematic::Result;

constexpr int kImages = 4;  // more than it wants before it believes what it sees

TEST(Reactive, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

TEST(Reactive, FliesStraightWhereNothingIsInTheWay) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const Course course = kinematic::meadow();
  const Result flight = kinematic::fly(planner, course);
  ASSERT_EQ(flight.ending, Ending::reached_goal);
  const double straight_m = (course.goal_world - course.start_world).norm() - 0.8;
  EXPECT_LT(flight.path_m, 1.01 * straight_m);
  EXPECT_LT(flight.time_s, straight_m / 2.5 + 2.0);
  EXPECT_GT(flight.lowest_m, 1.8);
  EXPECT_LT(flight.highest_m, 2.2);
}

TEST(Reactive, FliesStraightAndFastPastGhosts) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  course.ghost_count = 10;
  const Result flight = kinematic::fly(planner, course);
  ASSERT_EQ(flight.ending, Ending::reached_goal);
  const double straight_m = (course.goal_world - course.start_world).norm() - 0.8;
  EXPECT_LT(flight.path_m, 1.01 * straight_m);
  EXPECT_LT(flight.time_s, straight_m / 2.5 + 2.0);
}

TEST(Reactive, FliesAroundAThinPoleAmongGhosts) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  for (const int ghost_count : {0, 10}) {
    for (const double aside_m : {-0.2, -0.05, 0.0, 0.05, 0.2}) {
      Course course = kinematic::meadow();
      course.ghost_count = ghost_count;
      course.cylinders.push_back({{aside_m, 15.0}, 0.03});
      EXPECT_EQ(kinematic::fly(planner, course).ending, Ending::reached_goal)
          << aside_m << " m aside, " << ghost_count << " ghosts";
    }
  }
}

/// Flights of the seeds 0 … count - 1 that reach the goal.
int reached_count(const char* file, double poisson_radius_m, std::uint64_t count) {
  PlannerInstance planner = kinematic::instance_of(file);
  int reached = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const Result flight = kinematic::fly(planner, kinematic::forest(poisson_radius_m, seed));
    EXPECT_NE(flight.ending, Ending::failed) << flight.reason;
    if (flight.ending == Ending::reached_goal) ++reached;
  }
  return reached;
}

TEST(Reactive, ClearsASparseForest) {
  EXPECT_GE(reached_count(PLANNER_FILE, 5.0, 6), 5);
  // The straight line through the same trees says that they are in the way.
  EXPECT_LE(reached_count(STRAIGHT_LINE_FILE, 5.0, 6), 2);
}

TEST(Reactive, IsDecentInADenseForest) { EXPECT_GE(reached_count(PLANNER_FILE, 2.8, 4), 3); }

TEST(Reactive, FindsTheGapInAWall) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-8.0, 15.0}, {2.0, 15.0});
  add_hedge(course, {4.0, 15.0}, {8.0, 15.0});
  const Result flight = kinematic::fly(planner, course);
  EXPECT_EQ(flight.ending, Ending::reached_goal);
  EXPECT_LT(flight.path_m, 45.0);
}

TEST(Reactive, GetsOutOfADeadEnd) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-3.0, 16.0}, {3.0, 16.0});
  add_hedge(course, {-3.0, 12.0}, {-3.0, 16.0});
  add_hedge(course, {3.0, 12.0}, {3.0, 16.0});
  EXPECT_EQ(kinematic::fly(planner, course, 90.0).ending, Ending::reached_goal);
}

TEST(Reactive, TurnsFirstWhenTheGoalIsBehind) {
  const CameraSetup camera = kinematic::vehicle_setup().cameras.front();
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  PlannerMission mission;
  mission.start_world = {0.0, 0.0, 2.0};
  mission.goal_world = {-10.0, -1.0, 2.0};
  ASSERT_EQ(planner.reset(mission), "");
  PlannerView view;
  view.position_world = mission.start_world;
  view.velocity_world.setZero();
  view.rates_body.setZero();
  view.q_world_body.setIdentity();  // looks along +x
  DepthView depth;
  depth.T_world_camera = Eigen::Translation3d(mission.start_world) * camera.T_body_camera;
  const std::vector<float> pixels =
      kinematic::depth_image(kinematic::meadow(), camera, depth.T_world_camera);
  depth.depth_m = pixels;
  view.depth.push_back(depth);
  PlanResult plan;
  for (int image = 0; image < kImages; ++image) {
    view.time_s = 0.05 * image;
    plan = planner.plan(view);
    ASSERT_EQ(plan.status, PlanStatus::command) << plan.reason;
    const Eigen::Map<const Eigen::Vector3d> velocity(plan.command.velocity_world_mps);
    EXPECT_LT(velocity.norm(), 0.3);
  }
  EXPECT_GT(std::abs(plan.command.yaw_rad), 2.0);
}

TEST(Reactive, HoldsWhereItSeesNothing) {
  const CameraSetup camera = kinematic::vehicle_setup().cameras.front();
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  PlannerMission mission;
  mission.goal_world = {10.0, 0.0, 2.0};
  ASSERT_EQ(planner.reset(mission), "");
  PlannerView view;
  view.position_world = {0.0, 0.0, 2.0};
  view.velocity_world.setZero();
  view.rates_body.setZero();
  view.q_world_body.setIdentity();
  const std::vector<float> pixels(static_cast<std::size_t>(camera.width_px * camera.height_px),
                                  std::numeric_limits<float>::quiet_NaN());
  for (int image = 0; image <= kImages; ++image) {
    view.time_s = 0.05 * image;
    view.depth.clear();
    DepthView depth;
    depth.T_world_camera = Eigen::Translation3d(view.position_world) * camera.T_body_camera;
    depth.depth_m = pixels;
    if (image > 0) view.depth.push_back(depth);
    const PlanResult plan = planner.plan(view);
    ASSERT_EQ(plan.status, PlanStatus::command);
    EXPECT_EQ(Eigen::Map<const Eigen::Vector3d>(plan.command.velocity_world_mps).norm(), 0.0);
  }
}

/// What looks down adds to what looks ahead; it does not take its place.
TEST(Reactive, FliesWithASecondCameraThatLooksDown) {
  const PlannerSetup rig = kinematic::rig_setup();
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE, {}, rig);
  const Course meadow = kinematic::meadow();
  const Result straight = kinematic::fly(planner, meadow, 60.0, rig);
  ASSERT_EQ(straight.ending, Ending::reached_goal);
  EXPECT_LT(straight.path_m, 1.01 * ((meadow.goal_world - meadow.start_world).norm() - 0.8));
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Course forest = kinematic::forest(5.0, seed);
    PlannerInstance single = kinematic::instance_of(PLANNER_FILE);
    EXPECT_EQ(kinematic::fly(planner, forest, 60.0, rig).ending,
              kinematic::fly(single, forest).ending)
        << seed;
  }
}

TEST(Reactive, FliesTheMirroredCourseTheMirroredWay) {
  Course course = kinematic::meadow();
  course.cylinders.push_back({{0.15, 12.0}, 0.3});
  Course mirrored = course;
  mirrored.cylinders[0].centre.x() *= -1.0;
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const Result left = kinematic::fly(planner, course);
  const Result right = kinematic::fly(planner, mirrored);
  ASSERT_EQ(left.ending, Ending::reached_goal);
  ASSERT_EQ(right.ending, Ending::reached_goal);
  EXPECT_LT(left.positions[left.positions.size() / 3].x(), 0.0);
  EXPECT_GT(right.positions[right.positions.size() / 3].x(), 0.0);
}

}  // namespace
}  // namespace avoidbench
