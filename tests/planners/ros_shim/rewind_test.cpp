#include "rewind.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include "simulated_ros.hpp"
#include "std_msgs/Float64.h"

namespace ros_shim::test {
namespace {

std::vector<double> way;  // grows at each tick, as servers of set points have it
int ticks = 0;

/// A server as people write them: globals, a static variable, an object on main's stack.
void serve() {
  struct Server {
    double last = 0.0;
    std::vector<int> counted;
  } server;
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<std_msgs::Float64>("/set_point", 1);
  ros::Timer timer = node.createTimer(
      ros::Duration(0.1), ros::TimerCallback([&](const ros::TimerEvent&) {
        static double of_static = 0.0;
        of_static += 1.0;
        server.last += 1.0;
        server.counted.push_back(++ticks);
        way.push_back(server.last);
        std_msgs::Float64 message;
        message.data = of_static + server.last + static_cast<double>(server.counted.size()) +
                       static_cast<double>(way.size()) + ticks;
        publisher.publish(message);
      }));
  ros::spin();
}

/// Whatever a tick changes comes back after a run ahead: the same ticks give the same set points.
TEST(Rewind, PutsBackGlobalsStaticsStackAndContainers) {
  way.clear();
  ticks = 0;
  SimulatedRos ros({&serve});
  std::vector<std::pair<double, double>> given;
  ros::NodeHandle host;
  const ros::Subscriber held = host.subscribe<std_msgs::Float64>(
      "/set_point", 0, [&](const std_msgs::Float64ConstPtr& message) {
        given.emplace_back(now_s(), message->data);
      });
  ros.run_to(0.35);
  ASSERT_EQ(given.size(), 3U);
  for (int repeat = 0; repeat < 20; ++repeat) {
    given.clear();
    const Rewind rewind(*find_node("a"));
    advance_only(*find_node("a"), ros_shim::now_ns() + 1000000000);
    ASSERT_EQ(given.size(), 10U);
    EXPECT_EQ(given.front(), (std::pair<double, double>{0.4, 20.0})) << repeat;
    EXPECT_EQ(given.back(), (std::pair<double, double>{1.3, 65.0})) << repeat;
  }
  EXPECT_EQ(now_s(), 0.35);
  EXPECT_EQ(ticks, 3);
  EXPECT_EQ(way, (std::vector<double>{1.0, 2.0, 3.0}));
  given.clear();
  ros.run_to(0.5);
  EXPECT_EQ(given, (std::vector<std::pair<double, double>>{{0.4, 20.0}, {0.5, 25.0}}));
}

/// A server whose main loops with a rate instead of a timer.
TEST(Rewind, PutsBackALoopOfMain) {
  SimulatedRos ros({[] {
    ros::NodeHandle node;
    ros::Publisher publisher = node.advertise<std_msgs::Float64>("/set_point", 1);
    std_msgs::Float64 message;
    ros::Rate rate(10.0);
    for (int i = 0; ros::ok(); ++i) {
      message.data = i;
      publisher.publish(message);
      ros::spinOnce();
      rate.sleep();
    }
  }});
  std::vector<double> given;
  ros::NodeHandle host;
  const ros::Subscriber held = host.subscribe<std_msgs::Float64>(
      "/set_point", 0,
      [&](const std_msgs::Float64ConstPtr& message) { given.push_back(message->data); });
  ros.run_to(0.25);
  for (int repeat = 0; repeat < 3; ++repeat) {
    given.clear();
    const Rewind rewind(*find_node("a"));
    advance_only(*find_node("a"), ros_shim::now_ns() + 300000000);
    EXPECT_EQ(given, (std::vector<double>{3.0, 4.0, 5.0}));
  }
  given.clear();
  ros.run_to(0.35);
  EXPECT_EQ(given, (std::vector<double>{3.0}));
}

/// What nodes leave unset is the same in each trial, whatever the ones before did.
TEST(Rewind, MemoryOfNewIsZero) {
  constexpr std::size_t kBytes = 1000;
  for (int i = 0; i < 10; ++i) {
    std::unique_ptr<unsigned char[]> block(new unsigned char[kBytes]);
    for (std::size_t k = 0; k < kBytes; ++k) {
      ASSERT_EQ(block[k], 0) << i;
      block[k] = 0xff;
    }
  }
}

/// The C library's numbers from a state of the library's own, which a run ahead puts back.
TEST(Rewind, RandomNumbersArePutBack) {
  std::srand(1);
  EXPECT_EQ(std::rand(), 1804289383);
  std::vector<int> drawn;
  drawn.reserve(20);  // what a run ahead gets from new is gone after it
  SimulatedRos ros({[&] {
    ros::NodeHandle node;
    ros::Timer timer = node.createTimer(
        ros::Duration(0.1),
        ros::TimerCallback([&](const ros::TimerEvent&) { drawn.push_back(std::rand()); }));
    ros::spin();
  }});
  const auto drawn_ahead = [&] {
    drawn.clear();
    const Rewind rewind(*find_node("a"));
    advance_only(*find_node("a"), ros_shim::now_ns() + 500000000);
    return drawn.size();
  };
  ros.run_to(0.05);
  ASSERT_EQ(drawn_ahead(), 5U);
  const std::array<int, 5> first{drawn[0], drawn[1], drawn[2], drawn[3], drawn[4]};
  EXPECT_EQ(first[0], 846930886);
  ASSERT_EQ(drawn_ahead(), 5U);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), drawn.begin()));
}

}  // namespace
}  // namespace ros_shim::test
