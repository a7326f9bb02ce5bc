#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>

#include "geometry_msgs/PointStamped.h"
#include "simulated_ros.hpp"
#include "std_msgs/Int32.h"
#include "std_msgs/String.h"

namespace ros_shim::test {
namespace {

std_msgs::Int32 number(int value) {
  std_msgs::Int32 message;
  message.data = value;
  return message;
}

std::vector<int> taken;
void take_reference(const std_msgs::Int32& message) { taken.push_back(message.data); }
void take_pointer(const std_msgs::Int32ConstPtr& message) { taken.push_back(10 * message->data); }
void take_by_value(std_msgs::Int32Ptr message) {
  message->data *= 100;  // its own copy
  taken.push_back(message->data);
}
struct Taker {
  void take(const std_msgs::Int32::ConstPtr& message) { taken.push_back(1000 * message->data); }
  void take_event(const ros::MessageEvent<const std_msgs::Int32>& event) {
    publisher = event.getPublisherName();
    taken.push_back(10000 * event.getMessage()->data);
  }
  std::string publisher;
};

TEST(RosTopics, AnyFormOfCallbackGetsTheMessage) {
  taken.clear();
  Taker taker;
  SimulatedRos ros({[&] {
                      ros::NodeHandle node;
                      const ros::Subscriber a = node.subscribe("n", 5, take_reference);
                      const ros::Subscriber b = node.subscribe("n", 5, take_pointer);
                      const ros::Subscriber c = node.subscribe("n", 5, take_by_value);
                      const ros::Subscriber d = node.subscribe("n", 5, &Taker::take, &taker);
                      const ros::Subscriber e = node.subscribe("n", 5, &Taker::take_event, &taker);
                      const ros::Subscriber f = node.subscribe<std_msgs::Int32>(
                          "n", 5, [](const std_msgs::Int32::ConstPtr& message) {
                            taken.push_back(100000 * message->data);
                          });
                      const ros::Subscriber g = node.subscribe<std_msgs::Int32>(
                          "n", 5, &Taker::take, &taker, ros::TransportHints().tcpNoDelay());
                      ros::spin();
                    },
                    [&] {
                      ros::NodeHandle node;
                      ros::Publisher publisher = node.advertise<std_msgs::Int32>("n", 5);
                      EXPECT_EQ(publisher.getNumSubscribers(), 7U);
                      publisher.publish(number(1));
                      publisher.publish(std_msgs::Int32Ptr(new std_msgs::Int32(number(2))));
                      ros::spin();
                    }});
  ros.run_to(1.0);
  EXPECT_EQ(taken, (std::vector<int>{1, 10, 100, 1000, 10000, 100000, 1000,  //
                                     2, 20, 200, 2000, 20000, 200000, 2000}));
  EXPECT_EQ(taker.publisher, "/b");
}

TEST(RosTopics, AFullQueueDropsTheOldest) {
  taken.clear();
  SimulatedRos ros({[&] {
                      ros::NodeHandle node;
                      const ros::Subscriber held = node.subscribe("/n", 2, take_reference);
                      ros::Duration(1.0).sleep();
                      ros::spin();
                    },
                    [&] {
                      ros::NodeHandle node;
                      ros::Publisher publisher = node.advertise<std_msgs::Int32>("/n", 5);
                      for (int i = 0; i < 5; ++i) publisher.publish(number(i));
                    }});
  ros.run_to(0.5);
  EXPECT_TRUE(taken.empty());
  ros.run_to(1.5);
  EXPECT_EQ(taken, (std::vector<int>{3, 4}));
}

TEST(RosTopics, NodesTakeTurnsInTheOrderOfTheMessages) {
  std::string order;
  const auto listener = [&](char letter) {
    return [&order, letter] {
      ros::NodeHandle node;
      const ros::Subscriber held = node.subscribe<std_msgs::Int32>(
          "/n", 0, [&order, letter](const std_msgs::Int32ConstPtr&) { order += letter; });
      ros::spin();
    };
  };
  SimulatedRos ros({listener('a'), listener('b'), [&] {
                      ros::NodeHandle node;
                      ros::Publisher publisher = node.advertise<std_msgs::Int32>("/n", 5);
                      publisher.publish(number(1));
                      publisher.publish(number(2));
                    }});
  ros.run_to(0.1);
  EXPECT_EQ(order, "abab");
}

TEST(RosTopics, LatchedMessagesReachWhoComesLater) {
  taken.clear();
  SimulatedRos ros({[&] {
                      ros::NodeHandle node;
                      ros::Publisher publisher = node.advertise<std_msgs::Int32>("/n", 5, true);
                      publisher.publish(number(7));
                      ros::spin();
                    },
                    [&] {
                      ros::Duration(0.5).sleep();
                      ros::NodeHandle node;
                      const ros::Subscriber held = node.subscribe("/n", 2, take_reference);
                      ros::spin();
                    }});
  ros.run_to(1.0);
  EXPECT_EQ(taken, (std::vector<int>{7}));
}

TEST(RosTopics, ATypeThatIsAnotherIsAnError) {
  SimulatedRos ros({[] {
                      ros::NodeHandle node;
                      const ros::Publisher held = node.advertise<std_msgs::Int32>("/n", 5);
                      ros::spin();
                    },
                    [] {
                      ros::NodeHandle node;
                      const ros::Publisher held = node.advertise<std_msgs::String>("/n", 5);
                    }});
  try {
    ros.run_to(0.1);
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(),
                 "node /b: topic /n carries std_msgs/Int32, and /b takes it for std_msgs/String");
  }
}

TEST(RosNodes, PollingLoopsAndWaitsForMessagesGoOn) {
  taken.clear();
  bool was_waited_for = false;
  SimulatedRos ros({[&] {
                      ros::NodeHandle node;
                      const ros::Subscriber held = node.subscribe("/n", 1, take_reference);
                      while (ros::ok() && taken.empty()) ros::spinOnce();  // no sleep
                      taken.push_back(-1);
                      ros::Rate rate(100);
                      while (ros::ok()) {
                        ros::spinOnce();
                        rate.sleep();
                      }
                    },
                    [&] {
                      was_waited_for = ros::topic::waitForMessage<std_msgs::Int32>("/n") != nullptr;
                      ros::AsyncSpinner spinner(1);
                      spinner.start();
                      ros::waitForShutdown();
                    },
                    [&] {
                      ros::NodeHandle node;
                      ros::Publisher publisher = node.advertise<std_msgs::Int32>("/n", 5);
                      ros::Duration(0.3).sleep();
                      publisher.publish(number(3));
                      ros::Duration(0.3).sleep();
                      publisher.publish(number(4));
                      ros::spin();
                    }});
  ros.run_to(1.0);
  EXPECT_EQ(taken, (std::vector<int>{3, -1, 4}));
  EXPECT_TRUE(was_waited_for);
}

TEST(RosNodes, EndUnwindsWhatDoesNotAskWhetherRosIsOk) {
  struct Witness {
    explicit Witness(int& count_) : count(&count_) {}
    ~Witness() { ++*count; }
    int* count;
  };
  int gone = 0;
  {
    SimulatedRos ros({[&] {
                        const Witness witness(gone);
                        ros::spin();
                      },
                      [&] {
                        const Witness witness(gone);
                        while (true) ros::spinOnce();
                      },
                      [&] {
                        const Witness witness(gone);
                        while (true) ros::Duration(0.1).sleep();
                      }});
    ros.run_to(1.0);
    EXPECT_EQ(gone, 0);
  }
  EXPECT_EQ(gone, 3);
}

TEST(RosNodes, AnExceptionSaysWhichNodeItIsOf) {
  SimulatedRos ros({[] {
    ROS_INFO("before %d", 1);
    ROS_ASSERT(1 + 1 == 3);
  }});
  EXPECT_THROW(ros.run_to(0.1), std::runtime_error);
  EXPECT_EQ(ros.lines, (std::vector<std::string>{"[a] before 1"}));
}

/// Whether a thread of the node that runs is refused this, with the reason.
bool is_refused(const std::function<void()>& to_do) {
  std::string text;
  std::thread([&] {
    try {
      to_do();
    } catch (const std::logic_error& error) {
      text = error.what();
    }
  }).join();
  return text.find("a thread that a node has started uses ROS") == 0;
}

TEST(RosNodes, TheirThreadsMayOnlyLogAndReadClocks) {
  SimulatedRos ros({[&] {
    ros::NodeHandle node("~");
    ros::Publisher publisher = node.advertise<std_msgs::Int32>("n", 5);
    ros::Timer timer = node.createTimer(ros::Duration(0.1), [](const ros::TimerEvent&) {});
    EXPECT_FALSE(is_refused([] { ROS_INFO("said"); }));
    EXPECT_FALSE(is_refused([] { EXPECT_TRUE(ros::ok()); }));
    EXPECT_FALSE(is_refused([] { EXPECT_GE(ros::Time::now(), ros::Time(10)); }));
    EXPECT_TRUE(is_refused([&] { publisher.publish(number(1)); }));
    EXPECT_TRUE(is_refused([&] { node.subscribe("m", 5, take_reference); }));
    EXPECT_TRUE(is_refused([&] { timer.stop(); }));
    EXPECT_TRUE(is_refused([] { ros::Rate(10.0).sleep(); }));
    EXPECT_TRUE(is_refused([] { ros::spin(); }));
    EXPECT_TRUE(is_refused([] { ros::spinOnce(); }));
    EXPECT_TRUE(is_refused([] { ros::service::waitForService("s", 1.0); }));
    // Of whichever node is running at that moment.
    EXPECT_TRUE(is_refused([] { ros::shutdown(); }));
    EXPECT_TRUE(is_refused([&] { node.param("p", 1); }));
    publisher.publish(number(2));
  }});
  ros.run_to(1.0);
  EXPECT_EQ(ros.lines, (std::vector<std::string>{"[a] said"}));
}

TEST(RosNames, AreResolvedAndRemapped) {
  std::map<std::string, std::string> names;
  SimulatedRos ros({[&] {
                     ros::NodeHandle node, own("~"), group("group"), below(own, "fsm/x");
                     names["global"] = node.resolveName("/a/b/");
                     names["relative"] = node.resolveName("a");
                     names["own"] = own.resolveName("a");
                     names["group"] = group.resolveName("a");
                     names["below"] = below.resolveName("a");
                     names["remapped"] = own.resolveName("odom");
                     names["remapped_topic"] = own.advertise<std_msgs::Int32>("odom", 1).getTopic();
                     EXPECT_THROW(node.resolveName("a b"), std::invalid_argument);
                     EXPECT_THROW(node.advertise<std_msgs::Int32>("~n", 1), std::invalid_argument);
                     EXPECT_EQ(ros::this_node::getName(), "/a");
                   }},
                   {{"~odom", "/vehicle/odom"}});
  ros.run_to(0.1);
  EXPECT_EQ(names, (std::map<std::string, std::string>{{"global", "/a/b"},
                                                       {"relative", "/a"},
                                                       {"own", "/a/a"},
                                                       {"group", "/group/a"},
                                                       {"below", "/a/fsm/x/a"},
                                                       {"remapped", "/vehicle/odom"},
                                                       {"remapped_topic", "/vehicle/odom"}}));
}

TEST(RosParameters, AreReadAsRoscppReadsThem) {
  SimulatedRos ros({[] {
    ros::NodeHandle own("~");
    double real = 0.0;
    int whole = 0;
    bool flag = false;
    std::string text;
    std::vector<double> list;
    std::map<std::string, double> map;
    EXPECT_TRUE(own.getParam("real", real) && real == 0.5);
    EXPECT_TRUE(own.getParam("whole", real) && real == 3.0);
    EXPECT_TRUE(own.getParam("whole", whole) && whole == 3);
    EXPECT_TRUE(own.getParam("three", whole) && whole == 3);
    EXPECT_FALSE(own.getParam("real", whole));
    EXPECT_FALSE(own.getParam("whole", flag));
    EXPECT_TRUE(own.getParam("/text", text) && text == "words");
    EXPECT_TRUE(own.getParam("list", list) && list == (std::vector<double>{1.0, 2.5}));
    EXPECT_TRUE(own.getParam("map", map) && map["b"] == 2.0 && map.size() == 2U);
    EXPECT_FALSE(own.param("missing", real, 7.5));
    EXPECT_EQ(real, 7.5);
    EXPECT_EQ(own.param<std::string>("missing", "preset"), "preset");
    EXPECT_TRUE(own.hasParam("map/a") && !own.hasParam("map/c"));
    own.setParam("map/c", 3);
    EXPECT_TRUE(ros::param::get("~map/c", whole) && whole == 3);
    EXPECT_TRUE(own.deleteParam("map") && !own.hasParam("map/a"));
  }});
  set_parameter("/a/real", 0.5);
  set_parameter("/a/whole", 3);
  set_parameter("/a/three", 3.0);
  set_parameter("/text", "words");
  set_parameter("/a/list", Value::list_of({1, 2.5}));
  set_parameter("/a/map", Value::map_of({{"a", 1}, {"b", 2.0}}));
  ros.run_to(0.1);
  EXPECT_EQ(ros.lines.size(), 2U);  // the two of another kind
}

TEST(RosConsole, ThrottlesByRosTimeAndSaysOnce) {
  SimulatedRos ros({[] {
    for (int i = 0; i < 20; ++i) {
      ROS_WARN_THROTTLE(0.5, "throttled %d", i);
      ROS_INFO_STREAM_ONCE("once " << i);
      ROS_DEBUG("never");
      ROS_INFO_COND(i == 3, "when three");
      ros::Duration(0.1).sleep();
    }
  }});
  ros.run_to(3.0);
  EXPECT_EQ(ros.lines,
            (std::vector<std::string>{"[a] throttled 0", "[a] once 0", "[a] when three",
                                      "[a] throttled 5", "[a] throttled 10", "[a] throttled 15"}));
}

TEST(RosMessages, AreZeroAtFirstComparedAndPrinted) {
  geometry_msgs::PointStamped a, b;
  EXPECT_EQ(a.point.x, 0.0);
  EXPECT_EQ(a, b);
  b.point.y = 1.5;
  EXPECT_NE(a, b);
  b.header.frame_id = "world";
  std::ostringstream out;
  out << b;
  EXPECT_EQ(out.str(),
            "header: \n  seq: 0\n  stamp: 0.000000000\n  frame_id: world\n"
            "point: \n  x: 0\n  y: 1.5\n  z: 0\n");
}

/// What nodes leave unset is the same in each trial, whatever the ones before did.
TEST(RosMemory, OfNewIsZero) {
  constexpr std::size_t kBytes = 1000;
  for (int i = 0; i < 10; ++i) {
    std::unique_ptr<unsigned char[]> block(new unsigned char[kBytes]);
    for (std::size_t k = 0; k < kBytes; ++k) {
      ASSERT_EQ(block[k], 0) << i;
      block[k] = 0xff;
    }
  }
}

/// The C library's numbers from a state of the library's own.
TEST(RosRandom, DrawsTheCLibrarysNumbers) {
  std::srand(1);
  EXPECT_EQ(std::rand(), 1804289383);
  EXPECT_EQ(std::rand(), 846930886);
}

}  // namespace
}  // namespace ros_shim::test
