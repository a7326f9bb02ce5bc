#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Int32.h>
#include <std_srvs/Empty.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "simulated_ros.hpp"

namespace ros_shim::test {
namespace {

bool answer(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  response.success = request.data;
  response.message = request.data ? "on" : "off";
  return true;
}

TEST(RosService, IsAnsweredWhenItsNodeSpins) {
  std::vector<std::string> heard;
  const auto server = [&] {
    ros::NodeHandle node;
    const ros::ServiceServer service = node.advertiseService("switch", answer);
    ros::Duration(0.5).sleep();  // as long as it does not spin nobody is answered
    ros::spin();
  };
  const auto client = [&] {
    ros::NodeHandle node;
    ros::ServiceClient calls = node.serviceClient<std_srvs::SetBool>("switch");
    EXPECT_TRUE(calls.waitForExistence());
    std_srvs::SetBool both;
    both.request.data = true;
    EXPECT_TRUE(calls.call(both));
    heard.push_back(both.response.message + " " + std::to_string(now_s()));
    both.request.data = false;
    EXPECT_TRUE(ros::service::call("/switch", both));
    heard.push_back(both.response.message);
  };
  SimulatedRos ros({client, server});
  ros.run_to(0.4);
  EXPECT_TRUE(heard.empty());
  ros.run_to(1.0);
  EXPECT_EQ(heard, (std::vector<std::string>{"on 0.500000", "off"}));
}

TEST(RosService, OfTheSameNodeIsAnsweredAtOnce) {
  struct Own {
    bool work(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
      response.message = "done";
      return true;
    }
  } own;
  std::string heard;
  SimulatedRos ros({[&] {
    ros::NodeHandle node("~");
    ros::ServiceServer service = node.advertiseService("work", &Own::work, &own);
    EXPECT_EQ(service.getService(), "/a/work");
    std_srvs::Trigger both;
    EXPECT_TRUE(ros::service::call("/a/work", both));
    heard = both.response.message;
    service.shutdown();
    EXPECT_FALSE(ros::service::exists("/a/work", false));
    EXPECT_FALSE(ros::service::call("/a/work", both));
  }});
  ros.run_to(0.0);
  EXPECT_EQ(heard, "done");
}

TEST(RosService, FalseAndNobodyAreFailures) {
  std::vector<bool> answers;
  SimulatedRos ros(
      {[&] {
         ros::NodeHandle node;
         const std::function<bool(std_srvs::Empty::Request&, std_srvs::Empty::Response&)> refuses =
             [](std_srvs::Empty::Request&, std_srvs::Empty::Response&) { return false; };
         const ros::ServiceServer service = node.advertiseService("refuses", refuses);
         ros::spin();
       },
       [&] {
         std_srvs::Empty empty;
         answers.push_back(ros::service::call("refuses", empty));
         answers.push_back(ros::service::call("nobody", empty));
         answers.push_back(ros::service::waitForService("nobody", ros::Duration(0.3)));
         EXPECT_NEAR(now_s(), 0.3, 1e-9);
       }});
  ros.run_to(1.0);
  EXPECT_EQ(answers, (std::vector<bool>{false, false, false}));
}

TEST(RosService, MayTakeTimeAndCallAnother) {
  std::string order;
  const auto slow = [&] {
    ros::NodeHandle node;
    const std::function<bool(std_srvs::Empty::Request&, std_srvs::Empty::Response&)> sleeps =
        [&](std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
          ros::Duration(0.2).sleep();
          order += 's';
          return true;
        };
    const ros::ServiceServer service = node.advertiseService("slow", sleeps);
    ros::spin();
  };
  const auto through = [&] {
    ros::NodeHandle node;
    const std::function<bool(std_srvs::Empty::Request&, std_srvs::Empty::Response&)> calls =
        [&](std_srvs::Empty::Request& request, std_srvs::Empty::Response& response) {
          order += 't';
          return ros::service::call("slow", request, response);
        };
    const ros::ServiceServer service = node.advertiseService("through", calls);
    ros::spin();
  };
  SimulatedRos ros({slow, through, [&] {
                      std_srvs::Empty empty;
                      EXPECT_TRUE(ros::service::call("through", empty));
                      order += "c " + std::to_string(now_s());
                    }});
  ros.run_to(1.0);
  EXPECT_EQ(order, "tsc 0.200000");
}

TEST(RosService, CallsHaveItsType) {
  SimulatedRos ros({[] {
                      ros::NodeHandle node;
                      const ros::ServiceServer service = node.advertiseService("switch", answer);
                      ros::spin();
                    },
                    [] {
                      std_srvs::Trigger other;
                      ros::service::call("switch", other);
                    }});
  try {
    ros.run_to(0.1);
    FAIL() << "a call of another type was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "node /b: service /switch takes std_srvs/SetBoolRequest, and /b calls it with "
                 "std_srvs/TriggerRequest");
  }
}

TEST(RosService, TwoOfOneNameAreRefused) {
  SimulatedRos ros({[] {
    ros::NodeHandle node;
    const ros::ServiceServer first = node.advertiseService("switch", answer);
    const ros::ServiceServer second = node.advertiseService("switch", answer);
  }});
  EXPECT_THROW(ros.run_to(0.1), std::runtime_error);
}

TEST(RosService, ACallerThatIsStillWaitingAtTheEndGoesOn) {
  bool is_answered = true;
  {
    SimulatedRos ros({[] {
                        ros::NodeHandle node;
                        const ros::ServiceServer service = node.advertiseService("switch", answer);
                        while (ros::ok()) ros::Duration(0.1).sleep();
                      },
                      [&] {
                        std_srvs::SetBool both;
                        is_answered = ros::service::call("switch", both);
                      }});
    ros.run_to(0.5);
  }
  EXPECT_FALSE(is_answered);
}

TEST(RosCallbackQueue, CallsWhatWaits) {
  std::vector<int> heard;
  std::vector<std::string> states;
  SimulatedRos ros({[&] {
                      ros::NodeHandle node;
                      ros::CallbackQueue queue;
                      node.setCallbackQueue(&queue);
                      const std::function<void(const std_msgs::Int32&)> takes =
                          [&](const std_msgs::Int32& message) { heard.push_back(message.data); };
                      const ros::Subscriber numbers = node.subscribe<std_msgs::Int32>(
                          "numbers", 10, [&](const std_msgs::Int32ConstPtr& m) { takes(*m); });
                      states.emplace_back(queue.isEmpty() ? "empty" : "some");
                      queue.callAvailable(ros::WallDuration(1.0));  // comes after 0.3 s
                      states.push_back(std::to_string(now_s()));
                      ros::Duration(0.25).sleep();  // two more wait
                      EXPECT_EQ(queue.callOne(), ros::CallbackQueue::Called);
                      states.push_back(std::to_string(heard.size()));
                      queue.callAvailable();
                    },
                    [] {
                      ros::NodeHandle node;
                      const ros::Publisher numbers = node.advertise<std_msgs::Int32>("numbers", 10);
                      ros::Duration(0.3).sleep();
                      std_msgs::Int32 number;
                      for (number.data = 1; number.data < 4; ++number.data) {
                        numbers.publish(number);
                        ros::Duration(0.1).sleep();
                      }
                    }});
  ros.run_to(1.0);
  EXPECT_EQ(states, (std::vector<std::string>{"empty", "0.300000", "2"}));
  EXPECT_EQ(heard, (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace ros_shim::test
