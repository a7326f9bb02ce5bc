#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "avoidbench/goals.hpp"
#include "avoidbench/planner.h"
#include "nodes_world.hpp"
#include "planner_spec.hpp"

namespace ros_shim {

/// Observations to topics.
class Observations {
 public:
  /// Throws std::runtime_error where a topic is of a lidar or a camera that the sensor lacks.
  Observations(const PlannerSpec& spec, const ab_setup& setup, const ab_mission& mission,
               Given given = {});
  // Messages refer to what is given.
  Observations(const Observations&) = delete;
  Observations& operator=(const Observations&) = delete;
  /// Publishes what is seen, at the present time; IMU samples and earlier states at theirs, for
  /// which it lets the nodes go on. `start`: no observation yet, the vehicle hovers at the
  /// mission's start.
  void publish(const ab_observation& seen, std::int64_t to_ns);
  void publish_start();

 private:
  enum class StateTopics { of_the_newest, of_all_states };
  void publish_samples(const ab_observation& seen, std::int64_t to_ns);
  void publish_imu(const ab_imu_sample& sample);
  void publish_state(const ab_state& state, StateTopics which);
  void publish_transforms(const ab_state& state);
  void publish_depth(const ab_depth_image& image);
  void publish_cloud(const ab_depth_image& image, std::size_t index);
  void publish_sweep(const ab_cloud& sweep);
  void publish_picture(const ab_picture& picture, int eye);
  void publish_goals();
  void publish_messages(bool are_starting);
  void publish_message(std::size_t index);

  /// Of any type; the timer repeats it, where it is repeated.
  struct Message {
    std::function<void()> publish;
    ros::Timer repeat;
    bool is_sent = false;
  };

  const PlannerSpec* spec_;
  ab_mission mission_;
  Given given_;
  std::vector<ab_camera> cameras_;
  std::vector<ab_lidar> lidars_;
  ros::NodeHandle host_;
  std::vector<ros::Publisher> odometry_, poses_, twists_, imu_, transforms_, camera_poses_, depth_,
      depth_info_, clouds_, sweeps_, pictures_, picture_info_, goals_;
  std::vector<Message> messages_;
  std::vector<std::int64_t> goal_due_ns_;
  avoidbench::CurrentGoal goal_;
  std::uint32_t sequence_ = 0;
  bool sees_states_ = false;
};

/// Set points to answers.
class Commands {
 public:
  /// `max_speed_mps`: the vehicle's and the planner's own limit, the lower of them.
  Commands(const CommandForm& form, const ab_setup& setup, const ab_mission& mission,
           double max_speed_mps);
  void take(SetPoints points);
  /// The answer at ROS time `now_ns`; none where no set point came or the last one is old.
  std::optional<ab_command> answer(std::int64_t now_ns, const ab_state& state);

 private:
  ab_command of_one(const SetPoint& point, std::int64_t now_ns, const ab_state& state);
  ab_command of_many(const SetPoints& points, std::int64_t now_ns);
  void warn_of_early(const SetPoint& point);
  void warn_of_far(const ab_command& command, const ab_state& state);

  CommandForm form_;
  double plan_period_s_, gravity_mps2_, far_m_;
  std::array<double, 3> start_world_m_;
  bool has_warned_of_early_ = false, has_warned_of_far_ = false;
  SetPoints last_;
  std::vector<ab_point> points_;
};

/// One trial's nodes, from their start to their end.
class Flight {
 public:
  Flight(const ab_host& host, const ab_setup& setup, const ab_mission& mission);
  ~Flight();
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;
  std::optional<ab_command> plan(const ab_observation& seen);

 private:
  PlannerSpec spec_;
  std::optional<NodesWorld> world_;
  std::unique_ptr<Observations> observations_;
  std::unique_ptr<Commands> commands_;
  ros::Subscriber command_;
};

/// What the copy of the library that flies a trial is called by.
struct CopyTable {
  void* (*begin)(const ab_host* host, const ab_setup* setup, const ab_mission* mission);
  ab_status (*plan)(void* flight, const ab_observation* seen, ab_command* command);
  void (*end)(void* flight);
};

/// The ROS time of a trial's time 0. Not zero: planners take a stamp of zero for none.
constexpr std::int64_t kStart_ns = 100000000000;
std::int64_t ros_time_ns(double time_s);

}  // namespace ros_shim
