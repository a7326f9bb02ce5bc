#include "export/flight_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace avoidbench {
namespace {

const Eigen::Quaterniond kLeft = yaw_rotation(std::numbers::pi / 2.0);  // looks along world y

TEST(FlightMessages, StampsAreWholeNanoseconds) {
  EXPECT_EQ(mcap_time(1.0 / 3.0), 333'333'333U);
  EXPECT_EQ(mcap_time(2.0 / 3.0), 666'666'667U);
  EXPECT_EQ(mcap_time(-0.1), 0U);
  const RosTime time = ros_time(mcap_time(3599.5));
  EXPECT_EQ(time.sec, 3599);
  EXPECT_EQ(time.nanosec, 500'000'000U);
}

TEST(FlightMessages, OdometryHasVelocitiesInTheBodysFrame) {
  const RosOdometry odometry =
      ros_odometry(0, {1.0, 2.0, 3.0}, kLeft, {0.0, 2.0, 0.5}, {0.1, 0.2, 0.3});
  EXPECT_EQ(odometry.header.frame_id, "map");
  EXPECT_EQ(odometry.child_frame_id, "base_link");
  EXPECT_NEAR(odometry.twist.twist.linear.x, 2.0, 1e-15);  // ahead
  EXPECT_NEAR(odometry.twist.twist.linear.y, 0.0, 1e-15);
  EXPECT_EQ(odometry.twist.twist.linear.z, 0.5);
  EXPECT_EQ(odometry.twist.twist.angular.x, 0.1);
}

TEST(FlightMessages, ThePathHasTenPosesASecondAndTheLast) {
  std::vector<Sample> samples(125);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time_s = 0.01 * static_cast<double>(i);
  }
  const RosPath path = ros_path(samples);
  ASSERT_EQ(path.poses.size(), 14U);
  EXPECT_EQ(path.poses.back().header.stamp.nanosec, 240'000'000U);
  EXPECT_TRUE(ros_path({}).poses.empty());
}

/// 200 × 100 pixels at a depth of 2 m but for two of them: each second row and column is taken.
TEST(FlightMessages, DepthPointsAreWhereTheCameraSawThem) {
  const CameraSetup camera{
      .width_px = 200, .height_px = 100, .fx_px = 100.0, .fy_px = 50.0, .cx_px = 99.5, .cy_px = 50};
  std::vector<float> depth_m(200 * 100, 2.0F);
  depth_m[0] = std::numeric_limits<float>::infinity();
  depth_m[2] = std::numeric_limits<float>::quiet_NaN();
  SeenPicture picture{.kind = PictureKind::depth, .camera = 1, .time_s = 0.5, .bytes = {}};
  picture.bytes.resize(depth_m.size() * sizeof(float));
  std::memcpy(picture.bytes.data(), depth_m.data(), picture.bytes.size());
  const RosPointCloud cloud = ros_depth_points(picture, camera);
  EXPECT_EQ(cloud.header.frame_id, "camera_1_optical");
  ASSERT_EQ(cloud.width, 100U * 50U - 2U);
  float first[3];
  std::memcpy(first, cloud.data.data(), sizeof first);
  EXPECT_FLOAT_EQ(first[0], static_cast<float>((4 - 99.5) / 100.0 * 2.0));
  EXPECT_FLOAT_EQ(first[1], -2.0F);
  EXPECT_FLOAT_EQ(first[2], 2.0F);
  const RosImage image = ros_image(picture, camera);
  EXPECT_EQ(image.encoding, "32FC1");
  EXPECT_EQ(image.step, 800U);
}

TEST(FlightMessages, TheRightEyeIsABaselineAway) {
  const CameraSetup camera{
      .width_px = 4, .height_px = 2, .fx_px = 100.0, .fy_px = 100.0, .baseline_m = 0.2};
  SeenPicture picture{.kind = PictureKind::left, .bytes = {}};
  EXPECT_EQ(ros_camera_info(picture, camera).p[3], 0.0);
  picture.kind = PictureKind::right;
  EXPECT_DOUBLE_EQ(ros_camera_info(picture, camera).p[3], -20.0);
}

/// Three small triangles along x; the third moves.
struct SmallWorld : testing::Test {
  SmallWorld() {
    Prototype prototype{.name = "triangle", .mesh = {}, .triangle_materials = {Material::bark}};
    prototype.mesh.vertices = {{0.0F, 0.0F, 0.0F}, {0.1F, 0.0F, 0.0F}, {0.0F, 0.1F, 0.0F}};
    prototype.mesh.triangles = {{0, 1, 2}};
    world.prototypes = {prototype};
    for (std::uint32_t i = 0; i < 3; ++i) {
      Instance instance{.prototype = 0, .obstacle = i};
      instance.T_world_prototype =
          Eigen::Translation3f(10.0F * static_cast<float>(i), 0.0F, 0.0F) * Eigen::Scaling(2.0F);
      world.instances.push_back(instance);
      world.obstacles.push_back({.kind = "thing"});
    }
    Route route;
    route.knots = {{0.0, {0.0, 0.0, 0.0}, 0.0}, {2.0, {0.0, 4.0, 0.0}, std::numbers::pi}};
    world.motions = {{.instance = 2, .path = route}};
  }
  World world;
};

TEST_F(SmallWorld, OfALargeMapThereIsWhatIsNearThePath) {
  std::vector<Sample> samples(1);
  samples[0].position_world = {9.0, 0.0, 0.0};
  std::size_t left_out = 9;
  RosMarkers markers = ros_map(world, 0, samples, 2, left_out);
  EXPECT_EQ(left_out, 0U);
  ASSERT_EQ(markers.markers.size(), 1U);
  EXPECT_EQ(markers.markers[0].ns, "bark");
  EXPECT_EQ(markers.markers[0].points.size(), 6U);  // not of what moves
  markers = ros_map(world, 0, samples, 1, left_out);
  EXPECT_EQ(left_out, 1U);
  ASSERT_EQ(markers.markers[0].points.size(), 3U);
  EXPECT_EQ(markers.markers[0].points[0].x, 10.0);
}

TEST_F(SmallWorld, WhatMovesHasAFrame) {
  const RosMarkers markers = ros_movers(world, 0);
  ASSERT_EQ(markers.markers.size(), 1U);
  EXPECT_EQ(markers.markers[0].header.frame_id, "mover_0");
  EXPECT_FLOAT_EQ(static_cast<float>(markers.markers[0].points[1].x), 0.2F);  // scaled
  const auto transforms = ros_mover_transforms(world, mcap_time(1.0));
  ASSERT_EQ(transforms.size(), 1U);
  EXPECT_EQ(transforms[0].child_frame_id, "mover_0");
  EXPECT_NEAR(transforms[0].transform.translation.x, 20.0, 1e-5);
  EXPECT_NEAR(transforms[0].transform.translation.y, 2.0, 1e-5);
  EXPECT_NEAR(transforms[0].transform.rotation.z, std::sqrt(0.5), 1e-6);  // a quarter turn
  EXPECT_NEAR(transforms[0].transform.rotation.w, std::sqrt(0.5), 1e-6);
}

}  // namespace
}  // namespace avoidbench
