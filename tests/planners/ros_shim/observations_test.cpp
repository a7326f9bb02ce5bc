#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "flight.hpp"
#include "nav_msgs/Odometry.h"
#include "sensor_msgs/Imu.h"
#include "sensor_msgs/PointCloud2.h"
#include "sensor_msgs/point_cloud2_iterator.h"
#include "simulated_ros.hpp"

namespace ros_shim::test {
namespace {

struct Heard {
  char what;       ///< i: IMU, a: odometry of all states, n: of the newest
  double stamp_s;  ///< of the trial
  double heard_s;  ///< likewise
};

double trial_s(std::int64_t ros_ns) { return static_cast<double>(ros_ns - ros_time_ns(0.0)) / 1e9; }

/// What a node hears of a call at 0.1 s that sees IMU samples and states since 0.
std::vector<Heard> heard_of_one_call() {
  std::vector<Heard> heard;
  const auto hear = [&](char what, const std_msgs::Header& header) {
    heard.push_back(
        {what, trial_s(static_cast<std::int64_t>(header.stamp.toNSec())), trial_s(now_ns())});
  };
  SimulatedRos ros({[&] {
    ros::NodeHandle node;
    const auto all = node.subscribe<nav_msgs::Odometry>(
        "/all", 10,
        [&](const nav_msgs::OdometryConstPtr& odometry) { hear('a', odometry->header); });
    const auto newest = node.subscribe<nav_msgs::Odometry>(
        "/newest", 10,
        [&](const nav_msgs::OdometryConstPtr& odometry) { hear('n', odometry->header); });
    const auto imu = node.subscribe<sensor_msgs::Imu>(
        "/imu", 10, [&](const sensor_msgs::ImuConstPtr& sample) { hear('i', sample->header); });
    ros::spin();
  }});
  set_now(ros_time_ns(0.0));
  ros.run_to(static_cast<double>(ros_time_ns(0.0) - SimulatedRos::kBegin_ns) / 1e9);

  PlannerSpec spec;
  spec.odometry.push_back({"/all", "world", "body", false, true});
  spec.odometry.push_back({"/newest", "world", "body", false, false});
  spec.imu.push_back({"/imu", "body", false});
  Observations observations(spec, ab_setup{}, ab_mission{});
  ab_state states[3]{};
  const ab_state* pointers[3];
  ab_imu_sample samples[2]{};
  for (int i = 0; i < 3; ++i) {
    states[i].time_s = 0.03 * (i + 1);
    pointers[i] = &states[i];
  }
  samples[0].time_s = 0.03;
  samples[1].time_s = 0.08;
  ab_observation seen{};
  seen.state = &states[2];
  seen.states = pointers;
  seen.state_count = 3;
  seen.imu = samples;
  seen.imu_count = 2;
  seen.time_s = 0.1;
  observations.publish(seen, ros_time_ns(0.1));
  advance(ros_time_ns(0.1));
  return heard;
}

TEST(Observations, EachSampleSinceTheLastCallComesAtItsOwnTime) {
  const std::vector<Heard> heard = heard_of_one_call();
  const std::vector<Heard> expected = {{'i', 0.03, 0.03}, {'a', 0.03, 0.03}, {'a', 0.06, 0.06},
                                       {'i', 0.08, 0.08}, {'a', 0.09, 0.09}, {'n', 0.09, 0.1}};
  ASSERT_EQ(heard.size(), expected.size());
  for (std::size_t i = 0; i < heard.size(); ++i) {
    EXPECT_EQ(heard[i].what, expected[i].what) << i;
    EXPECT_NEAR(heard[i].stamp_s, expected[i].stamp_s, 1e-6) << i;
    EXPECT_NEAR(heard[i].heard_s, expected[i].heard_s, 1e-6) << i;
  }
}

/// A lidar 0.1 m before and 0.2 m above the body's centre, turned to the left.
ab_lidar lidar_to_the_left() {
  ab_lidar lidar{};
  lidar.position_body_m[0] = 0.1;
  lidar.position_body_m[2] = 0.2;
  lidar.q_body_lidar[0] = lidar.q_body_lidar[3] = std::sqrt(0.5);
  return lidar;
}

/// What a node hears on /points of a call at 0.1 s that sees two sweeps of lidar 1, which ended at
/// 0.05 and 0.1 s, and one of lidar 0. The newer one is from (10, 20, 30), turned by 180° of yaw,
/// and met (1, 2, 3) m and (0, 0, 0.5) m in its frame; the older one met nothing.
std::vector<sensor_msgs::PointCloud2> points_heard(PointsIn points_in) {
  std::vector<sensor_msgs::PointCloud2> heard;
  SimulatedRos ros({[&] {
    ros::NodeHandle node;
    const auto points = node.subscribe<sensor_msgs::PointCloud2>(
        "/points", 10,
        [&](const sensor_msgs::PointCloud2ConstPtr& cloud) { heard.push_back(*cloud); });
    ros::spin();
  }});
  set_now(ros_time_ns(0.0));
  ros.run_to(static_cast<double>(ros_time_ns(0.0) - SimulatedRos::kBegin_ns) / 1e9);

  PlannerSpec spec;
  spec.sweeps.push_back({"/points", "a_frame", points_in, 1});
  const ab_lidar lidars[2] = {ab_lidar{}, lidar_to_the_left()};
  const ab_lidar* const lidar_pointers[2] = {&lidars[0], &lidars[1]};
  ab_setup setup{};
  setup.lidar_count = 2;
  setup.lidars = lidar_pointers;
  Observations observations(spec, setup, ab_mission{});

  const ab_lidar_point met[2] = {{{1.0F, 2.0F, 3.0F}, -0.04F, 0.3F},
                                 {{0.0F, 0.0F, 0.5F}, 0.0F, 0.7F}};
  const float miss[3] = {1.0F, 0.0F, 0.0F};
  ab_cloud sweeps[3]{};
  for (ab_cloud& sweep : sweeps) {
    sweep.position_world_m[0] = 10.0;
    sweep.position_world_m[1] = 20.0;
    sweep.position_world_m[2] = 30.0;
    sweep.q_world_lidar[3] = 1.0;
    sweep.misses_lidar = miss;
    sweep.miss_count = 1;
    sweep.time_s = 0.1;
    sweep.lidar = 1;
  }
  sweeps[0].points = met;
  sweeps[0].point_count = 2;
  sweeps[1].lidar = 0;
  sweeps[2].time_s = 0.05;
  const ab_cloud* const sweep_pointers[3] = {&sweeps[0], &sweeps[1], &sweeps[2]};
  ab_state state{};
  ab_observation seen{};
  seen.state = &state;
  seen.time_s = 0.1;
  seen.cloud_count = 3;
  seen.clouds = sweep_pointers;
  observations.publish(seen, ros_time_ns(0.1));
  advance(ros_time_ns(0.1));
  return heard;
}

std::vector<float> field_of(const sensor_msgs::PointCloud2& cloud, const char* name) {
  std::vector<float> values;
  for (sensor_msgs::PointCloud2ConstIterator<float> at(cloud, name); at != at.end(); ++at) {
    values.push_back(*at);
  }
  return values;
}

TEST(Observations, SweepsOfALidarAreClouds) {
  const std::vector<sensor_msgs::PointCloud2> heard = points_heard(PointsIn::lidar);
  ASSERT_EQ(heard.size(), 2U) << "of that lidar alone";
  EXPECT_NEAR(trial_s(static_cast<std::int64_t>(heard[0].header.stamp.toNSec())), 0.05, 1e-6)
      << "oldest first";
  EXPECT_EQ(heard[0].width, 0U) << "only what was met";
  EXPECT_TRUE(heard[0].data.empty());
  const sensor_msgs::PointCloud2& cloud = heard[1];
  EXPECT_NEAR(trial_s(static_cast<std::int64_t>(cloud.header.stamp.toNSec())), 0.1, 1e-6)
      << "the sweep's end";
  EXPECT_EQ(cloud.header.frame_id, "a_frame");
  EXPECT_EQ(cloud.height, 1U);
  EXPECT_EQ(cloud.width, 2U);
  EXPECT_EQ(cloud.point_step, 20U);
  EXPECT_EQ(cloud.row_step, 40U);
  EXPECT_EQ(cloud.data.size(), 40U);
  EXPECT_EQ(cloud.is_dense, 1);
  EXPECT_EQ(cloud.fields.size(), 5U);
  EXPECT_EQ(field_of(cloud, "x"), (std::vector<float>{1.0F, 0.0F}));
  EXPECT_EQ(field_of(cloud, "y"), (std::vector<float>{2.0F, 0.0F}));
  EXPECT_EQ(field_of(cloud, "z"), (std::vector<float>{3.0F, 0.5F}));
  EXPECT_EQ(field_of(cloud, "intensity"), (std::vector<float>{0.3F, 0.7F}));
  EXPECT_EQ(field_of(cloud, "time"), (std::vector<float>{-0.04F, 0.0F}));
}

TEST(Observations, PointsOfSweepsAreInTheCoordinatesThatAreAskedFor) {
  // The lidar's x is the body's y, and its y the body's -x.
  const sensor_msgs::PointCloud2 body = points_heard(PointsIn::body).at(1);
  EXPECT_NEAR(field_of(body, "x")[0], 0.1 - 2.0, 1e-6);
  EXPECT_NEAR(field_of(body, "y")[0], 1.0, 1e-6);
  EXPECT_NEAR(field_of(body, "z")[0], 3.2, 1e-6);
  EXPECT_NEAR(field_of(body, "z")[1], 0.7, 1e-6);
  const sensor_msgs::PointCloud2 world = points_heard(PointsIn::world).at(1);
  EXPECT_NEAR(field_of(world, "x")[0], 10.0 - 1.0, 1e-5);
  EXPECT_NEAR(field_of(world, "y")[0], 20.0 - 2.0, 1e-5);
  EXPECT_NEAR(field_of(world, "z")[0], 33.0, 1e-5);
}

/// What is wrong with these topics for a sensor with so many lidars and no camera.
std::string problem_of(const PlannerSpec& spec, std::uint32_t lidars) {
  const SimulatedRos ros({});
  const ab_lidar lidar{};
  const ab_lidar* const pointers[2] = {&lidar, &lidar};
  ab_setup setup{};
  setup.lidar_count = lidars;
  setup.lidars = pointers;
  try {
    const Observations observations(spec, setup, ab_mission{});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Observations, TopicsOfWhatTheSensorLacksAreToldByName) {
  PlannerSpec spec;
  spec.sweeps.push_back({"/points", "world", PointsIn::world, 2});
  EXPECT_EQ(problem_of(spec, 2),
            "publish: /points: there is no lidar 2: the sensor has 2, counted from 0");
  EXPECT_EQ(problem_of(spec, 0), "publish: /points: is of a lidar, and the sensor has none");
  spec.sweeps[0].lidar = 1;
  EXPECT_EQ(problem_of(spec, 2), "");
  spec.depth.push_back({"/depth", "camera", "", PixelFormat::float_m, 0.0, 0.0, 0});
  EXPECT_EQ(problem_of(spec, 2), "publish: /depth: is of a camera, and the sensor has none");
}

}  // namespace
}  // namespace ros_shim::test
