#include <gtest/gtest.h>
#include <tf/transform_listener.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2/utils.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>

#include "flight.hpp"
#include "simulated_ros.hpp"

namespace ros_shim::test {
namespace {

constexpr double kHalf = 0.70710678118654752;  // sine and cosine of 45°
constexpr std::int64_t kSecond = 1000000000;

FramePose at(double x, double y, double z, double yaw_sine = 0.0, double yaw_cosine = 1.0) {
  return {{x, y, z}, {0.0, 0.0, yaw_sine, yaw_cosine}};
}

void expect_near(const FramePose& pose, const FramePose& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(pose.translation[i], expected.translation[i], 1e-12) << i;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(pose.rotation[i], expected.rotation[i], 1e-12) << i;
}

geometry_msgs::TransformStamped message_of(const std::string& parent, const std::string& child,
                                           double x, const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform.translation.x = x;
  message.transform.rotation.w = 1.0;
  return message;
}

TEST(Frames, GoUpToTheCommonOneAndDownAgain) {
  Frames frames(10 * kSecond);
  frames.set("world", "body", kSecond, at(1.0, 2.0, 3.0, kHalf, kHalf), false);  // to the left
  frames.set("/body", "/camera", 0, at(0.5, 0.0, 0.1), true);
  frames.set("world", "goal", kSecond, at(1.0, 4.0, 3.0), false);
  std::int64_t at_ns = 0;
  expect_near(frames.lookup("world", "camera", kSecond, at_ns), at(1.0, 2.5, 3.1, kHalf, kHalf));
  expect_near(frames.lookup("camera", "world", kSecond, at_ns),
              inverse(at(1.0, 2.5, 3.1, kHalf, kHalf)));
  // Two metres ahead of the body, which looks along y.
  expect_near(frames.lookup("body", "goal", kSecond, at_ns), at(2.0, 0.0, 0.0, -kHalf, kHalf));
  expect_near(frames.lookup("goal", "goal", kSecond, at_ns), at(0.0, 0.0, 0.0));
}

TEST(Frames, LieBetweenTheirSamplesEvenly) {
  Frames frames(10 * kSecond);
  frames.set("world", "body", 3 * kSecond, at(4.0, 0.0, 0.0, kHalf, kHalf), false);
  frames.set("world", "body", kSecond, at(0.0, 2.0, 0.0), false);
  std::int64_t at_ns = 0;
  const double sine = std::sin(M_PI / 16.0), cosine = std::cos(M_PI / 16.0);
  expect_near(frames.lookup("world", "body", kSecond + kSecond / 2, at_ns),
              at(1.0, 1.5, 0.0, sine, cosine));
  // The same rotation by the other sign: the shorter way.
  FramePose other = at(4.0, 0.0, 0.0, kHalf, kHalf);
  for (double& part : other.rotation) part = -part;
  frames.set("world", "twin", 3 * kSecond, other, false);
  frames.set("world", "twin", kSecond, at(0.0, 2.0, 0.0), false);
  expect_near(frames.lookup("world", "twin", kSecond + kSecond / 2, at_ns),
              at(1.0, 1.5, 0.0, sine, cosine));
}

TEST(Frames, AtTimeZeroAreTheNewestThatAllLinksHave) {
  Frames frames(10 * kSecond);
  for (int i = 1; i < 5; ++i) frames.set("world", "body", i * kSecond, at(i, 0.0, 0.0), false);
  for (int i = 1; i < 3; ++i) frames.set("body", "arm", i * kSecond, at(0.0, i, 0.0), false);
  frames.set("arm", "hand", 0, at(0.0, 0.0, 1.0), true);
  std::int64_t at_ns = 0;
  expect_near(frames.lookup("world", "hand", 0, at_ns), at(2.0, 2.0, 1.0));
  EXPECT_EQ(at_ns, 2 * kSecond);
}

TEST(Frames, SayWhatTheyDoNotKnow) {
  Frames frames(2 * kSecond);
  frames.set("world", "body", kSecond, at(0.0, 0.0, 0.0), false);
  frames.set("map", "other", kSecond, at(0.0, 0.0, 0.0), false);
  const auto problem = [&](const char* target, const char* source, std::int64_t time_ns) {
    std::int64_t at_ns = 0;
    try {
      frames.lookup(target, source, time_ns, at_ns);
    } catch (const FrameError& error) {
      return std::to_string(error.kind) + error.what();
    }
    return std::string();
  };
  EXPECT_EQ(problem("world", "bodi", 0),
            "0\"bodi\" passed to lookupTransform argument source_frame does not exist. ");
  const auto begins = [&](const std::string& text, const std::string& with) {
    EXPECT_EQ(text.substr(0, with.size()), with);
  };
  begins(problem("world", "other", 0), "1Could not find a connection between 'world' and 'other'");
  begins(problem("world", "body", 2 * kSecond),
         "2Lookup would require extrapolation into the future. Requested time 2.000000 but the "
         "latest data is at time 1.000000, when");
  begins(problem("world", "body", 1), "2Lookup would require extrapolation into the past. ");
  // What is older than two seconds before the newest is gone.
  frames.set("world", "body", 4 * kSecond, at(0.0, 0.0, 0.0), false);
  EXPECT_NE(problem("world", "body", 3 * kSecond), "");
  frames.set("body", "world", 4 * kSecond, at(0.0, 0.0, 0.0), false);
  EXPECT_EQ(problem("world", "body", 0), "1The tf tree is invalid: it contains a loop.");
}

TEST(TransformListener, HearsWithoutSpinningAndWaits) {
  std::vector<double> found;
  const auto says = [] {
    tf2_ros::TransformBroadcaster moving;
    tf2_ros::StaticTransformBroadcaster fixed;
    fixed.sendTransform(message_of("body", "camera", 0.5, ros::Time::now()));
    for (int i = 0; i < 5; ++i) {
      ros::Duration(0.1).sleep();
      moving.sendTransform(message_of("world", "body", i, ros::Time::now()));
    }
  };
  const auto hears = [&] {
    tf2_ros::Buffer buffer;
    const tf2_ros::TransformListener listener(buffer);
    EXPECT_FALSE(buffer.canTransform("world", "camera", ros::Time(0)));
    EXPECT_THROW(buffer.lookupTransform("world", "camera", ros::Time(0), ros::Duration(0.05)),
                 tf2::LookupException);
    const auto first = buffer.lookupTransform("world", "camera", ros::Time(0), ros::Duration(1.0));
    found = {now_s(), first.transform.translation.x};
    ros::Duration(0.15).sleep();
    const auto later = buffer.lookupTransform("world", "camera", ros::Time(0));
    found.push_back(later.transform.translation.x);
  };
  SimulatedRos ros({says, hears});
  ros.run_to(1.0);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], 0.1, 0.011);
  EXPECT_EQ(found[1], 0.5);
  EXPECT_EQ(found[2], 1.5);
}

TEST(TransformListener, OfTfTakesPosesToOtherFrames) {
  geometry_msgs::PoseStamped moved;
  SimulatedRos ros({[&] {
    tf::TransformListener listener;
    tf::TransformBroadcaster broadcaster;
    const tf::Transform pose(tf::createQuaternionFromYaw(M_PI / 2.0), tf::Vector3(1.0, 2.0, 3.0));
    const ros::Time now = ros::Time::now();
    broadcaster.sendTransform(tf::StampedTransform(pose, now, "world", "body"));
    EXPECT_TRUE(listener.waitForTransform("world", "body", now, ros::Duration(1.0)));
    tf::StampedTransform heard;
    listener.lookupTransform("world", "body", ros::Time(0), heard);
    EXPECT_EQ(heard.stamp_, now);
    EXPECT_EQ(heard.getOrigin().z(), 3.0);
    geometry_msgs::PoseStamped ahead;
    ahead.header.frame_id = "body";
    ahead.header.stamp = now;
    ahead.pose.position.x = 2.0;
    ahead.pose.orientation.w = 1.0;
    listener.transformPose("world", ahead, moved);
    tf2::Quaternion turned;
    tf2::fromMsg(moved.pose.orientation, turned);
    EXPECT_NEAR(tf2::getYaw(turned), M_PI / 2.0, 1e-12);
    EXPECT_THROW(listener.lookupTransform("map", "body", now, heard), tf::LookupException);
  }});
  ros.run_to(0.1);
  EXPECT_EQ(moved.header.frame_id, "world");
  EXPECT_NEAR(moved.pose.position.x, 1.0, 1e-12);
  EXPECT_NEAR(moved.pose.position.y, 4.0, 1e-12);
  EXPECT_NEAR(moved.pose.position.z, 3.0, 1e-12);
}

TEST(Observations, TransformsOfTheVehicleAndItsCamera) {
  geometry_msgs::TransformStamped camera_in_world;
  SimulatedRos ros({[&] {
    tf2_ros::Buffer buffer;
    const tf2_ros::TransformListener listener(buffer);
    camera_in_world =
        buffer.lookupTransform("map", "camera_optical", ros::Time(0), ros::Duration(1e3));
  }});
  ros.run_to(0.0);
  ab_camera camera{};
  camera.position_body_m[0] = 0.2;
  camera.q_body_camera[0] = 1.0;
  const ab_camera* cameras[1] = {&camera};
  ab_setup setup{};
  setup.cameras = cameras;
  PlannerSpec spec;
  spec.transforms.push_back({"/tf", "map", "base_link", "camera_optical", 1});
  EXPECT_THROW(Observations(spec, setup, ab_mission{}), std::runtime_error);
  setup.camera_count = 1;
  spec.transforms[0].camera = 0;
  Observations observations(spec, setup, ab_mission{});
  ab_state state{};
  state.time_s = 0.1;
  state.position_world_m[1] = 5.0;
  state.q_world_body[0] = 1.0;
  ab_observation seen{};
  seen.state = &state;
  seen.time_s = 0.1;
  observations.publish(seen, ros_time_ns(0.1));
  advance(ros_time_ns(0.2));
  EXPECT_EQ(camera_in_world.transform.translation.x, 0.2);
  EXPECT_EQ(camera_in_world.transform.translation.y, 5.0);
  EXPECT_EQ(camera_in_world.header.stamp.toNSec(), ros_time_ns(0.1));
}

}  // namespace
}  // namespace ros_shim::test
