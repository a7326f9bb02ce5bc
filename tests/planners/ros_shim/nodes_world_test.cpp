#include "nodes_world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "avoidbench/planner.hpp"

namespace ros_shim {
namespace {

constexpr double kHalfTurn_rad = 3.141592653589793;

void expect_near(const double (&found)[3], const std::array<double, 3>& expected) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
}

/// Its origin lies at (1, 2, 3), and its x axis points along y.
NodesWorld quarter() { return {{1.0, 2.0, 3.0}, 0.5 * kHalfTurn_rad}; }

TEST(NodesWorld, MissionsLieInIt) {
  const double goals[6] = {1.0, 7.0, 3.0, 4.0, 7.0, 5.0};
  ab_mission mission{};
  mission.struct_size = sizeof(ab_mission);
  mission.start_world_m[0] = 1.0;
  mission.start_world_m[1] = 2.0;
  mission.start_world_m[2] = 4.0;
  mission.start_yaw_rad = 0.5 * kHalfTurn_rad;
  std::copy_n(goals, 3, mission.goal_world_m);
  mission.goal_count = 2;
  mission.goals_world_m = goals;
  std::copy_n(std::array{-10.0, -20.0, 0.0}.begin(), 3, mission.lowest_world_m);
  std::copy_n(std::array{10.0, 20.0, 5.0}.begin(), 3, mission.highest_world_m);
  NodesWorld world = quarter();
  const ab_mission turned = world.of(mission);
  expect_near(turned.start_world_m, {0.0, 0.0, 1.0});
  EXPECT_NEAR(turned.start_yaw_rad, 0.0, 1e-12);
  expect_near(turned.goal_world_m, {5.0, 0.0, 0.0});
  EXPECT_NEAR(turned.goals_world_m[3], 5.0, 1e-12);
  EXPECT_NEAR(turned.goals_world_m[4], -3.0, 1e-12);
  EXPECT_NEAR(turned.goals_world_m[5], 2.0, 1e-12);
  expect_near(turned.lowest_world_m, {-22.0, -9.0, -3.0});
  expect_near(turned.highest_world_m, {18.0, 11.0, 2.0});
}

/// A point that a camera and a lidar see is the same place, whichever world one asks in.
TEST(NodesWorld, WhatIsSeenLiesInIt) {
  ab_state state{};
  state.struct_size = sizeof(ab_state);
  state.position_world_m[0] = 3.0;
  state.velocity_world_mps[1] = 2.0;
  state.q_world_body[0] = state.q_world_body[3] = std::sqrt(0.5);  // along y
  ab_depth_image image{};
  image.struct_size = sizeof(ab_depth_image);
  image.fx_px = image.fy_px = 100.0;
  image.position_world_m[0] = 3.0;
  image.q_world_camera[0] = 0.6;
  image.q_world_camera[1] = 0.8;
  const ab_lidar_point hit{{1.0F, 2.0F, 3.0F}, 0.0F, 0.0F};
  ab_cloud cloud{};
  cloud.struct_size = sizeof(ab_cloud);
  cloud.q_world_lidar[0] = 0.8;
  cloud.q_world_lidar[2] = 0.6;
  cloud.point_count = 1;
  cloud.points = &hit;
  const ab_depth_image* images[1] = {&image};
  const ab_cloud* clouds[1] = {&cloud};
  ab_observation seen{};
  seen.struct_size = sizeof(ab_observation);
  seen.state = &state;
  seen.depth_count = seen.cloud_count = 1;
  seen.depth = images;
  seen.clouds = clouds;

  NodesWorld world = quarter();
  const ab_observation& turned = world.of(seen);
  expect_near(turned.state->position_world_m, {-2.0, -2.0, -3.0});
  expect_near(turned.state->velocity_world_mps, {2.0, 0.0, 0.0});
  EXPECT_NEAR(turned.state->q_world_body[0], 1.0, 1e-12);
  const auto expect_same_place = [](const avoidbench::Vec3& own, const avoidbench::Vec3& hosts) {
    EXPECT_NEAR(own[0], hosts[1] - 2.0, 1e-12);
    EXPECT_NEAR(own[1], 1.0 - hosts[0], 1e-12);
    EXPECT_NEAR(own[2], hosts[2] - 3.0, 1e-12);
  };
  expect_same_place(avoidbench::pixel_in_world(*turned.depth[0], 20.0, 10.0, 4.0),
                    avoidbench::pixel_in_world(image, 20.0, 10.0, 4.0));
  expect_same_place(avoidbench::point_in_world(*turned.clouds[0], hit),
                    avoidbench::point_in_world(cloud, hit));
}

TEST(NodesWorld, CommandsComeOutOfIt) {
  NodesWorld world = quarter();
  std::vector<ab_point> points(2);
  points[1].time_s = 1.0;
  points[1].position_world_m[0] = 2.0;
  points[1].velocity_world_mps[0] = 3.0;
  points[1].jerk_world_mps3[1] = 1.0;
  const ab_command turned = world.back(avoidbench::make_trajectory_command(points));
  ASSERT_EQ(turned.point_count, 2U);
  expect_near(turned.points[0].position_world_m, {1.0, 2.0, 3.0});
  expect_near(turned.points[1].position_world_m, {1.0, 4.0, 3.0});
  expect_near(turned.points[1].velocity_world_mps, {0.0, 3.0, 0.0});
  expect_near(turned.points[1].jerk_world_mps3, {-1.0, 0.0, 0.0});
  EXPECT_NEAR(turned.points[1].yaw_rad, 0.5 * kHalfTurn_rad, 1e-12);
  const ab_command place = world.back(avoidbench::make_position_command({1.0, 0.0, 0.0}, 0.1));
  expect_near(place.position_world_m, {1.0, 3.0, 3.0});
  EXPECT_NEAR(place.yaw_rad, 0.5 * kHalfTurn_rad + 0.1, 1e-12);
}

}  // namespace
}  // namespace ros_shim
