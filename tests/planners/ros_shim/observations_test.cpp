#include <gtest/gtest.h>

#include <vector>

#include "flight.hpp"
#include "nav_msgs/Odometry.h"
#include "sensor_msgs/Imu.h"
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

}  // namespace
}  // namespace ros_shim::test
