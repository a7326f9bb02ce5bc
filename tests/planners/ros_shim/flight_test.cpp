#include "flight.hpp"

#include <gtest/gtest.h>
#include <quadrotor_msgs/PositionCommand.h>
#include <std_msgs/Empty.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulated_ros.hpp"

namespace ros_shim {
namespace {

/// What the test flies; make_planner.py writes this for a planner.
PlannerSpec& flown_spec() {
  static PlannerSpec spec;
  return spec;
}

}  // namespace

PlannerSpec planner_spec() { return flown_spec(); }
const ab_planner planner_table{};

namespace test {
namespace {

double trial_s() { return static_cast<double>(now_ns() - kStart_ns) / 1e9; }

ros::Subscriber subscribe(ros::NodeHandle& host, const CommandForm& form,
                          std::function<void(SetPoints)> take) {
  return host.subscribe<quadrotor_msgs::PositionCommand>(
      form.topic, 0, [take](const quadrotor_msgs::PositionCommandConstPtr& message) {
        take(points_of_position_command(*message, now_ns()));
      });
}

std::function<void()> advertise_heartbeat(ros::NodeHandle& host, const Given&) {
  const ros::Publisher publisher = host.advertise<std_msgs::Empty>("/heartbeat", 1, true);
  return [publisher] { publisher.publish(std_msgs::Empty()); };
}

/// Trials of nodes "a" and "b" with two seconds before time 0, whose command topic is /command, for
/// a vehicle of at most 3 m/s.
class RosFlight : public testing::Test {
 protected:
  RosFlight() {
    PlannerSpec& spec = flown_spec();
    spec = {};
    spec.lead_s = 2.0;
    spec.command.topic = "/command";
    spec.set_parameters = [](const Given&) {};
    spec.subscribe = &subscribe;
    host_.context = &log_;
    host_.log = [](void* context, std::int32_t, const char* text) {
      static_cast<std::vector<std::string>*>(context)->emplace_back(text);
    };
    setup_.struct_size = sizeof setup_;
    setup_.plan_period_s = 0.1;
    setup_.max_speed_mps = 3.0;
    setup_.value_count = 1;
    setup_.values = &value_pointer_;
    mission_.struct_size = sizeof mission_;
    mission_.goal_world_m[0] = 10.0;
  }

  void begin(std::vector<std::function<void()>> mains) {
    bodies() = std::move(mains);
    int (*const functions[])(int, char**) = {&main_of<0>, &main_of<1>};
    const char* const names[] = {"a", "b"};
    for (std::size_t i = 0; i < bodies().size(); ++i) {
      flown_spec().nodes.push_back({names[i], "/", functions[i], {}, {}});
    }
    flight_.emplace(host_, setup_, mission_);
  }
  /// A call at this time of the trial, of a vehicle that stands at its start.
  std::optional<ab_command> plan(double time_s) {
    ab_state state{};
    state.time_s = time_s;
    state.q_world_body[0] = 1.0;
    ab_observation seen{};
    seen.struct_size = sizeof seen;
    seen.state = &state;
    seen.time_s = time_s;
    return flight_->plan(seen);
  }

  std::vector<std::string> log_;
  ab_host host_{};
  ab_value value_{sizeof(ab_value), 0, 1.0, nullptr};
  const ab_value* value_pointer_ = &value_;
  ab_setup setup_{};
  ab_mission mission_{};
  std::optional<Flight> flight_;
};

quadrotor_msgs::PositionCommand command_to(double x_m, double speed_mps = 0.0) {
  quadrotor_msgs::PositionCommand command;
  command.position.x = x_m;
  command.velocity.x = speed_mps;
  return command;
}

TEST_F(RosFlight, OfTwoSetPointsInOneTickTheLastCounts) {
  begin({[] {
    ros::NodeHandle node;
    const ros::Publisher commands = node.advertise<quadrotor_msgs::PositionCommand>("/command", 1);
    const ros::Timer timer =
        node.createTimer(ros::Duration(0.1), ros::TimerCallback([&](const ros::TimerEvent&) {
                           if (trial_s() < 0.0) return;
                           commands.publish(command_to(0.5));
                           commands.publish(command_to(1.0));
                         }));
    ros::spin();
  }});
  const std::optional<ab_command> command = plan(0.1);
  ASSERT_TRUE(command.has_value());
  EXPECT_EQ(command->points[0].position_world_m[0], 1.0);
  EXPECT_TRUE(log_.empty());
}

/// Whichever node is the later one in the topics file.
TEST_F(RosFlight, OfTwoNodesSetPointsTheLastToBePublishedCounts) {
  const auto says_at = [](double time_s, double x_m) {
    return [time_s, x_m] {
      ros::NodeHandle node;
      const ros::Publisher commands =
          node.advertise<quadrotor_msgs::PositionCommand>("/command", 1);
      ros::Duration(2.0 + time_s).sleep();
      commands.publish(command_to(x_m));
      ros::spin();
    };
  };
  begin({says_at(0.08, 1.0), says_at(0.04, 0.5)});
  const std::optional<ab_command> command = plan(0.1);
  ASSERT_TRUE(command.has_value());
  EXPECT_EQ(command->points[0].position_world_m[0], 1.0);
}

TEST_F(RosFlight, HeartbeatsComeAtTheirTimesInTheLeadAndWhileANodeSleeps) {
  flown_spec().messages.push_back({"/heartbeat", true, 0.04, &advertise_heartbeat});
  std::vector<double> heard;
  const auto listener = [&] {
    ros::NodeHandle node;
    const ros::Subscriber beats = node.subscribe<std_msgs::Empty>(
        "/heartbeat", 10, [&](const std_msgs::EmptyConstPtr&) { heard.push_back(trial_s()); });
    ros::spin();
  };
  const auto sleeper = [] {
    ros::NodeHandle node;
    const ros::Timer timer = node.createTimer(
        ros::Duration(0.5),
        ros::TimerCallback([](const ros::TimerEvent&) { ros::Duration(0.3).sleep(); }));
    ros::spin();
  };
  begin({listener, sleeper});
  // Calls are not in step with heartbeats, and one comes late.
  for (const double time_s : {0.0, 0.1, 0.2, 0.5, 0.6}) plan(time_s);
  ASSERT_EQ(heard.size(), 66U);
  for (std::size_t i = 0; i < heard.size(); ++i) {
    EXPECT_NEAR(heard[i], -2.0 + 0.04 * static_cast<double>(i), 1e-9) << i;
  }
}

TEST_F(RosFlight, HeartbeatsWithTheGoalBeginWithIt) {
  flown_spec().messages.push_back({"/heartbeat", false, 0.04, &advertise_heartbeat});
  std::vector<double> heard;
  begin({[&] {
    ros::NodeHandle node;
    const ros::Subscriber beats = node.subscribe<std_msgs::Empty>(
        "/heartbeat", 10, [&](const std_msgs::EmptyConstPtr&) { heard.push_back(trial_s()); });
    ros::spin();
  }});
  plan(0.0);
  plan(0.1);
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_NEAR(heard[0], 0.0, 1e-9);
  EXPECT_NEAR(heard[2], 0.08, 1e-9);
}

/// Commands along x at 2 m/s from `begin_s` of the trial on.
std::function<void()> self_starter(double begin_s) {
  return [begin_s] {
    ros::NodeHandle node;
    const ros::Publisher commands = node.advertise<quadrotor_msgs::PositionCommand>("/command", 1);
    const ros::Timer timer = node.createTimer(
        ros::Duration(0.05), ros::TimerCallback([&](const ros::TimerEvent&) {
          const double after_s = trial_s() - begin_s;
          commands.publish(after_s < 0.0 ? command_to(0.0) : command_to(2.0 * after_s, 2.0));
        }));
    ros::spin();
  };
}

TEST_F(RosFlight, APlannerThatStartsInTheLeadIsTold) {
  begin({self_starter(-1.535)});
  ASSERT_EQ(log_.size(), 1U);
  EXPECT_EQ(log_[0],
            "[a] a command to move came on /command 1.50 s before the trial's time 0, when the "
            "vehicle does not fly yet: does the planner start by itself within lead_s?");
  plan(0.9);
  EXPECT_EQ(log_.size(), 1U);
  // Beyond 2 m and what the vehicle flies in a second; once.
  plan(1.0);
  plan(1.1);
  ASSERT_EQ(log_.size(), 2U);
  EXPECT_EQ(
      log_[1],
      "[avoidbench] the set point is 5.1 m from the vehicle (topic /command): does the planner "
      "start before the trial's time 0 (lead_s)?");
}

TEST_F(RosFlight, APlannerThatHoversInTheLeadIsNot) {
  begin({self_starter(0.0)});
  plan(0.5);
  EXPECT_TRUE(log_.empty());
}

}  // namespace
}  // namespace test
}  // namespace ros_shim
