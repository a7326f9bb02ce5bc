#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "geometry/pose.hpp"
#include "planners/support/trajectory_flight.hpp"
#include "planners/support/trajectory_suite.hpp"

namespace avoidbench::kinematic {
namespace {

const TrajectoryPlanner kMbplanner{.name = "mbplanner",
                                   .file = PLANNER_FILE,
                                   .speed_limit_mps = 3.003,
                                   .detour = 1.03,
                                   .height_band_m = 0.5,
                                   .published_speed_limit_mps = 1.001,
                                   .is_random = true};

INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlight, testing::Values(kMbplanner), name_of);
INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlightSlow, testing::Values(kMbplanner), name_of);

/// Through a gap that only its tightest box fits in it creeps: a stop before it is free.
TEST(Mbplanner, SqueezesThroughANarrowGapSlowly) {
  PlannerInstance planner = instance_of(PLANNER_FILE);
  Course course = meadow();
  add_hedge(course, {-8.275, 15.0}, {-0.775, 15.0});
  add_hedge(course, {0.775, 15.0}, {8.275, 15.0});
  const TrajectoryResult result = fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  const std::vector<Eigen::Vector3d>& places = result.flight.positions;
  int count_in_gap = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const bool is_in_gap = std::abs(places[i].y() - 15.0) < 0.3 && std::abs(places[i].x()) < 0.8;
    if (!is_in_gap) continue;
    ++count_in_gap;
    EXPECT_LT(30.0 * (places[i] - places[i - 1]).norm(), 1.2) << places[i].transpose();
  }
  EXPECT_GT(count_in_gap, 10);  // not around the hedge
}

/// One call at a time on a meadow; the vehicle is where the test says.
class OnAMeadow : public testing::Test {
 protected:
  OnAMeadow() {
    PlannerMission mission;
    mission.start_world = {0.0, 0.0, 2.0};
    mission.goal_world = {0.0, 30.0, 2.0};
    mission.start_yaw_rad = 0.5 * math::kPi;
    mission.goal_radius_m = 0.8;
    mission.time_limit_s = 60.0;
    EXPECT_EQ(planner_.reset(mission), "");
  }
  /// What is commanded at `position`, at rest, by an image along y.
  PlanResult planned_at(const Eigen::Vector3d& position, double time_s) {
    PlannerView view;
    view.time_s = view.call_time_s = time_s;
    view.position_world = position;
    view.velocity_world = view.rates_body = Eigen::Vector3d::Zero();
    view.q_world_body = yaw_rotation(0.5 * math::kPi);
    DepthView depth;
    depth.time_s = time_s;
    depth.T_world_camera = make_pose(position, view.q_world_body) * camera_.T_body_camera;
    const std::vector<float> pixels = depth_image(meadow(), camera_, depth.T_world_camera);
    depth.depth_m = pixels;
    view.depth.push_back(depth);
    return planner_.plan(view);
  }

  CameraSetup camera_ = vehicle_setup().cameras.front();
  PlannerInstance planner_ = instance_of(PLANNER_FILE);
};

/// Where the commanded trajectory ends.
Eigen::Vector3d end_of(const PlanResult& plan) {
  return Eigen::Vector3d::Map(plan.points.back().position_world_m);
}

/// A vehicle that was blown aside plans from where it is, in the very same call.
TEST_F(OnAMeadow, FindsANewPathAtOnceWhereItIsNotOnItsOwn) {
  for (int i = 0; i < 2; ++i) {
    const PlanResult plan = planned_at({0.0, 0.0, 2.0}, i / 30.0);
    ASSERT_EQ(plan.status, PlanStatus::command) << plan.reason;
    EXPECT_GT(end_of(plan).y(), 1.0);
  }
  const PlanResult plan = planned_at({0.8, -0.4, 2.0}, 2.0 / 30.0);
  ASSERT_EQ(plan.status, PlanStatus::command) << plan.reason;
  EXPECT_LT(
      (Eigen::Vector3d::Map(plan.points.front().position_world_m) - Eigen::Vector3d(0.8, -0.4, 2.0))
          .norm(),
      0.05);
  EXPECT_GT(end_of(plan).y(), 1.0);
}

TEST(Mbplanner, ClimbsToAGoalFarAboveItsStart) {
  PlannerInstance planner = instance_of(PLANNER_FILE);
  Course course = meadow();
  course.goal_world = course.start_world + Eigen::Vector3d(0.0, 25.0, 4.0);
  const TrajectoryResult result = fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  EXPECT_GT(result.flight.positions.back().z(), course.goal_world.z() - 1.0);
}

TEST(Mbplanner, GetsOutOfADeadEnd) {
  PlannerInstance planner = instance_of(PLANNER_FILE);
  Course course = meadow();
  add_hedge(course, {-3.0, 16.0}, {3.0, 16.0});
  add_hedge(course, {-3.0, 12.0}, {-3.0, 16.0});
  add_hedge(course, {3.0, 12.0}, {3.0, 16.0});
  const TrajectoryResult result = fly_trajectories(planner, course, 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  EXPECT_LE(result.demands.speed_mps, kMbplanner.speed_limit_mps);
}

}  // namespace
}  // namespace avoidbench::kinematic
