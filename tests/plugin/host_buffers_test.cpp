#include "plugin/host_buffers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <latch>
#include <string>
#include <thread>
#include <vector>

namespace avoidbench {
namespace {

/// Two cameras of 4 × 3 pixels, the second one looking back.
PlannerSetup two_cameras() {
  PlannerSetup setup;
  CameraSetup camera;
  camera.width_px = 4;
  camera.height_px = 3;
  camera.fx_px = camera.fy_px = 2.0;
  camera.baseline_m = 0.25;
  camera.T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  setup.cameras = {camera, camera};
  setup.cameras[1].T_body_camera.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  return setup;
}

TEST(HostBuffers, SetupListsEveryCameraForWhoeverSeesImages) {
  const PlannerSetup setup = two_cameras();
  for (const std::uint32_t needs : {AB_INPUT_DEPTH, AB_INPUT_STEREO, AB_INPUT_COLOR}) {
    const SetupBuffers buffers(setup, {}, needs);
    ASSERT_EQ(buffers.setup().camera_count, 2U);
    EXPECT_EQ(buffers.setup().depth_camera, buffers.setup().cameras[0]);
    EXPECT_EQ(buffers.setup().cameras[1]->baseline_m, 0.25);
    EXPECT_EQ(buffers.setup().cameras[1]->struct_size, sizeof(ab_camera));
    // Looking back is half a turn about body z from looking ahead.
    const double* ahead = buffers.setup().cameras[0]->q_body_camera;
    const double* back = buffers.setup().cameras[1]->q_body_camera;
    const Eigen::Quaterniond q_ahead(ahead[0], ahead[1], ahead[2], ahead[3]);
    const Eigen::Quaterniond q_back(back[0], back[1], back[2], back[3]);
    EXPECT_NEAR(q_ahead.angularDistance(q_back), 3.14159265358979, 1e-6);
    EXPECT_TRUE((q_back * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitX(), 1e-12));
  }
  const SetupBuffers blind(setup, {}, AB_INPUT_STATE | AB_INPUT_IMU);
  EXPECT_EQ(blind.setup().depth_camera, nullptr);
  EXPECT_EQ(blind.setup().camera_count, 0U);
}

TEST(HostBuffers, ThreadsOfAPlannerMayLogAtOnce) {
  constexpr int kThreads = 4, kLines = 2000;
  HostSide host;
  const ab_host& table = host.table();
  // Some rounds: on a busy machine the threads of one may run one after another.
  for (int round = 0; round < 30; ++round) {
    std::latch start(kThreads);
    std::vector<std::thread> threads;
    for (int thread = 0; thread < kThreads; ++thread) {
      threads.emplace_back([&table, &start, thread] {
        const std::string name = std::to_string(thread) + ":";
        start.arrive_and_wait();
        for (int i = 0; i < kLines; ++i) {
          table.log(table.context, AB_LOG_INFO, (name + std::to_string(i)).c_str());
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    std::vector<std::string> lines = host.take_log();
    ASSERT_EQ(lines.size(), std::size_t{kThreads * kLines});
    std::sort(lines.begin(), lines.end());
    ASSERT_EQ(std::unique(lines.begin(), lines.end()), lines.end()) << "a line was kept twice";
  }
}

class Observations : public ::testing::Test {
 protected:
  Observations() : depth_m(12, 3.0F), left(12, 10), right(12, 20), rgb(36, 30) {
    view.position_world = view.velocity_world = view.rates_body = Eigen::Vector3d::Zero();
    view.q_world_body.setIdentity();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = setup.cameras[0].T_body_camera.linear();
    pose.translation() << 1.0, 2.0, 3.0;
    view.depth.push_back({0.5, pose, 1, depth_m});
    view.stereo.push_back({0.5, pose, 1, left, right});
    view.stereo.push_back({0.4, pose, 0, right, left});
    view.color.push_back({0.5, pose, 1, rgb});
    view.imu.push_back({0.48, {0.1, 0.2, 0.3}, {0.0, 0.0, 9.8}});
    view.imu.push_back({0.49, {0.4, 0.5, 0.6}, {0.0, 0.0, 9.9}});
  }

  PlannerSetup setup = two_cameras();
  std::vector<float> depth_m;
  std::vector<std::uint8_t> left, right, rgb;
  PlannerView view;
  ObservationBuffers buffers;
};

TEST_F(Observations, AllStatesArriveWhereTheyAreAskedFor) {
  view.call_time_s = 0.7;
  for (const double time_s : {0.60, 0.65}) {
    view.states.push_back({.time_s = time_s,
                           .position_world = {time_s, 2.0, 3.0},
                           .velocity_world = {0.1, 0.2, 0.3},
                           .rates_body = {0.4, 0.5, 0.6},
                           .q_world_body = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)});
  }
  const ab_observation& seen = buffers.fill(view, setup.cameras, AB_INPUT_STATES);
  EXPECT_EQ(seen.time_s, 0.7);
  ASSERT_EQ(seen.state_count, 2U);
  const ab_state& last = *seen.states[1];
  EXPECT_EQ(last.struct_size, sizeof(ab_state));
  EXPECT_EQ(last.time_s, 0.65);
  EXPECT_EQ(last.position_world_m[0], 0.65);
  EXPECT_EQ(last.velocity_world_mps[1], 0.2);
  EXPECT_EQ(last.rates_body_radps[2], 0.6);
  EXPECT_EQ(last.q_world_body[2], -0.5);
  EXPECT_EQ(buffers.fill(view, setup.cameras, AB_INPUT_STATE).state_count, 0U);
}

TEST_F(Observations, TheReferenceArrivesWhereItIsAskedForAndThereIsOne) {
  view.call_time_s = 0.7;
  view.reference = ReferenceView{.position_world = {1.0, 2.0, 3.0},
                                 .velocity_world = {4.0, 5.0, 6.0},
                                 .acceleration_world = {7.0, 8.0, 9.0},
                                 .jerk_world = {10.0, 11.0, 12.0},
                                 .yaw_rad = 0.5,
                                 .yaw_rate_radps = 0.25};
  EXPECT_EQ(buffers.fill(view, setup.cameras, AB_INPUT_STATE).reference, nullptr);
  const ab_point* reference = buffers.fill(view, setup.cameras, AB_INPUT_REFERENCE).reference;
  ASSERT_NE(reference, nullptr);
  EXPECT_EQ(reference->time_s, 0.7);
  EXPECT_EQ(reference->position_world_m[2], 3.0);
  EXPECT_EQ(reference->velocity_world_mps[0], 4.0);
  EXPECT_EQ(reference->acceleration_world_mps2[1], 8.0);
  EXPECT_EQ(reference->jerk_world_mps3[2], 12.0);
  EXPECT_EQ(reference->yaw_rad, 0.5);
  EXPECT_EQ(reference->yaw_rate_radps, 0.25);
  view.reference.reset();
  EXPECT_EQ(buffers.fill(view, setup.cameras, AB_INPUT_REFERENCE).reference, nullptr);
}

TEST_F(Observations, SweepsArriveWhereTheyAreAskedFor) {
  const std::vector<ab_lidar_point> points{{{1.0F, 2.0F, 3.0F}, -0.05F, 0.5F},
                                           {{4.0F, 5.0F, 6.0F}, 0.0F, 0.25F}};
  const std::vector<Eigen::Vector3f> misses{{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 7.0, 8.0, 9.0;
  view.clouds.push_back({0.6, pose, 1, points, misses});
  view.clouds.push_back({0.5, pose, 0, {}, {}});
  const ab_observation& seen = buffers.fill(view, setup.cameras, AB_INPUT_POINTS);
  ASSERT_EQ(seen.cloud_count, 2U);
  EXPECT_EQ(seen.depth_count, 0U);
  const ab_cloud& newest = *seen.clouds[0];
  EXPECT_EQ(newest.struct_size, sizeof(ab_cloud));
  EXPECT_EQ(newest.lidar, 1U);
  EXPECT_EQ(newest.time_s, 0.6);
  EXPECT_EQ(newest.position_world_m[2], 9.0);
  EXPECT_EQ(newest.q_world_lidar[0], 1.0);
  ASSERT_EQ(newest.point_count, 2U);
  EXPECT_EQ(newest.points[1].position_lidar_m[2], 6.0F);
  ASSERT_EQ(newest.miss_count, 2U);
  EXPECT_EQ(newest.misses_lidar[4], 1.0F);
  EXPECT_EQ(seen.clouds[1]->point_count, 0U);
  EXPECT_EQ(buffers.fill(view, setup.cameras, AB_INPUT_DEPTH).cloud_count, 0U);
}

TEST(HostBuffers, SetupListsLidarsForWhoeverSeesPoints) {
  PlannerSetup setup = two_cameras();
  LidarSetup lidar;
  lidar.T_body_lidar.translation() << 0.0, 0.0, 0.1;
  lidar.rate_hz = 10.0;
  lidar.shots = 20000;
  lidar.is_deskewed = false;
  setup.lidars = {LidarSetup{}, lidar};
  const SetupBuffers buffers(setup, {}, AB_INPUT_POINTS);
  ASSERT_EQ(buffers.setup().lidar_count, 2U);
  EXPECT_EQ(buffers.setup().camera_count, 0U);
  EXPECT_EQ(buffers.setup().lidars[0]->is_deskewed, 1U);
  const ab_lidar& second = *buffers.setup().lidars[1];
  EXPECT_EQ(second.struct_size, sizeof(ab_lidar));
  EXPECT_EQ(second.is_deskewed, 0U);
  EXPECT_EQ(second.position_body_m[2], 0.1);
  EXPECT_EQ(second.shots, 20000U);
  EXPECT_EQ(SetupBuffers(setup, {}, AB_INPUT_DEPTH).setup().lidar_count, 0U);
}

TEST_F(Observations, TheGoalArrivesWhereItIsAskedFor) {
  view.goal = GoalView{.index = 2, .place_world = {1.0, 2.0, 3.0}};
  EXPECT_EQ(buffers.fill(view, setup.cameras, AB_INPUT_STATE).goal_index, 0U);
  EXPECT_EQ(buffers.fill(view, setup.cameras, AB_INPUT_STATE).goal_world_m[0], 0.0);
  const ab_observation& seen = buffers.fill(view, setup.cameras, AB_INPUT_GOALS);
  EXPECT_EQ(seen.goal_index, 2U);
  EXPECT_EQ(seen.goal_world_m[0], 1.0);
  EXPECT_EQ(seen.goal_world_m[2], 3.0);
}

TEST_F(Observations, TracksArriveWhereTheyAreAskedFor) {
  view.tracks = {{.id = 9,
                  .kind = AB_TRACK_BALL,
                  .time_s = 0.65,
                  .center_world = {1.0, 2.0, 3.0},
                  .velocity_world = {4.0, 5.0, 6.0},
                  .size_m = {0.5, 0.6, 0.7}}};
  EXPECT_EQ(buffers.fill(view, setup.cameras, AB_INPUT_STATE).track_count, 0U);
  const ab_observation& seen = buffers.fill(view, setup.cameras, AB_INPUT_TRACKS);
  ASSERT_EQ(seen.track_count, 1U);
  EXPECT_EQ(seen.tracks[0].id, 9U);
  EXPECT_EQ(seen.tracks[0].kind, AB_TRACK_BALL);
  EXPECT_EQ(seen.tracks[0].time_s, 0.65);
  EXPECT_EQ(seen.tracks[0].center_world_m[2], 3.0);
  EXPECT_EQ(seen.tracks[0].velocity_world_mps[1], 5.0);
  EXPECT_EQ(seen.tracks[0].size_m[0], 0.5);
}

TEST(HostSideOf, KeepsNoMoreOfErrorsAndLogsThanPeopleRead) {
  HostSide host;
  const ab_host& table = host.table();
  const std::string long_text(std::size_t{4} << 20U, 'x');
  table.set_error(table.context, long_text.c_str());
  EXPECT_LT(host.take_error().size(), 11'000U);
  for (int i = 0; i < 1000; ++i) table.log(table.context, AB_LOG_WARNING, long_text.c_str());
  const std::vector<std::string> log = host.take_log();
  std::size_t bytes = 0;
  for (const std::string& line : log) bytes += line.size();
  EXPECT_LE(bytes, std::size_t{1} << 20U);
  EXPECT_NE(log.back().find("left out"), std::string::npos);
  table.log(table.context, AB_LOG_WARNING, "short");
  EXPECT_EQ(host.take_log(), std::vector<std::string>{"warning: short"});
}

TEST(MissionOf, SaysTheMapsBoxAndTheLatency) {
  PlannerMission mission;
  mission.lowest_world = {-1.0, -2.0, -3.0};
  mission.highest_world = {4.0, 5.0, 6.0};
  mission.command_latency_s = 0.033;
  const ab_mission told = to_mission(mission);
  EXPECT_EQ(told.struct_size, sizeof(ab_mission));
  EXPECT_EQ(told.lowest_world_m[2], -3.0);
  EXPECT_EQ(told.highest_world_m[1], 5.0);
  EXPECT_EQ(told.command_latency_s, 0.033);
}

TEST(MissionOf, HasAllGoals) {
  PlannerMission mission;
  mission.goal_world = {1.0, 2.0, 3.0};
  const ab_mission one = to_mission(mission);
  EXPECT_EQ(one.goal_count, 1U);
  EXPECT_EQ(one.goals_world_m[2], 3.0);
  mission.goals_world = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  const ab_mission two = to_mission(mission);
  EXPECT_EQ(two.goal_count, 2U);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(two.goals_world_m[i], i + 1.0);
}

TEST_F(Observations, PicturesAndSamplesArriveWithTheirTimesAndPlaces) {
  const ab_observation& seen = buffers.fill(
      view, setup.cameras, AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR | AB_INPUT_IMU);
  ASSERT_EQ(seen.depth_count, 1U);
  EXPECT_EQ(seen.depth[0]->camera, 1U);
  ASSERT_EQ(seen.stereo_count, 2U);
  const ab_stereo_pair& pair = *seen.stereo[0];
  EXPECT_EQ(pair.struct_size, sizeof(ab_stereo_pair));
  EXPECT_EQ(pair.baseline_m, 0.25);
  EXPECT_EQ(pair.left->channels, 1U);
  EXPECT_EQ(pair.left->camera, 1U);
  EXPECT_EQ(pair.left->pixels, left.data());
  EXPECT_EQ(pair.right->pixels, right.data());
  // Camera x is body -y: the right eye is 0.25 m to the right.
  EXPECT_EQ(pair.left->position_world_m[1], 2.0);
  EXPECT_NEAR(pair.right->position_world_m[1], 1.75, 1e-12);
  EXPECT_EQ(seen.stereo[1]->left->time_s, 0.4);
  ASSERT_EQ(seen.color_count, 1U);
  EXPECT_EQ(seen.color[0]->channels, 3U);
  EXPECT_EQ(seen.color[0]->pixels, rgb.data());
  ASSERT_EQ(seen.imu_count, 2U);
  EXPECT_EQ(seen.imu[1].time_s, 0.49);
  EXPECT_EQ(seen.imu[0].rates_body_radps[2], 0.3);
  EXPECT_EQ(seen.imu[1].specific_force_body_mps2[2], 9.9);
}

TEST_F(Observations, OnlyWhatIsDeclaredArrives) {
  const ab_observation& seen = buffers.fill(view, setup.cameras, AB_INPUT_STATE | AB_INPUT_COLOR);
  EXPECT_EQ(seen.depth_count, 0U);
  EXPECT_EQ(seen.stereo_count, 0U);
  EXPECT_EQ(seen.color_count, 1U);
  EXPECT_EQ(seen.imu_count, 0U);
}

}  // namespace
}  // namespace avoidbench
