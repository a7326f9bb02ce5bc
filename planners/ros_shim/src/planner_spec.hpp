#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "avoidbench/planner.h"
#include "core.hpp"
#include "ros/node_handle.h"
#include "ros_shim/set_point.h"

/// What a topics file says, as make_planner.py writes it into the source of a planner.
namespace ros_shim {

/// What `${…}` may name: numbers of ab_setup and ab_mission.
struct Given {
  double vehicle_max_speed_mps = 0.0, vehicle_max_acceleration_mps2 = 0.0;
  double vehicle_max_yaw_rate_radps = 0.0, gravity_mps2 = 0.0, plan_period_s = 0.0;
  double body_length_m = 0.0, body_width_m = 0.0, body_height_m = 0.0, body_radius_m = 0.0;
  double width_px = 0.0, height_px = 0.0, fx_px = 0.0, fy_px = 0.0, cx_px = 0.0, cy_px = 0.0;
  double camera_rate_hz = 0.0, min_range_m = 0.0, max_range_m = 0.0, baseline_m = 0.0;
  double camera_x_m = 0.0, camera_y_m = 0.0, camera_z_m = 0.0;
  double lidar_rate_hz = 0.0, lidar_min_range_m = 0.0, lidar_max_range_m = 0.0;  ///< the first one
  double lidar_x_m = 0.0, lidar_y_m = 0.0, lidar_z_m = 0.0;
  double start_x_m = 0.0, start_y_m = 0.0, start_z_m = 0.0, start_yaw_rad = 0.0;
  double goal_x_m = 0.0, goal_y_m = 0.0, goal_z_m = 0.0, goal_radius_m = 0.0;
  double lowest_x_m = 0.0, lowest_y_m = 0.0, lowest_z_m = 0.0;  ///< the map's box
  double highest_x_m = 0.0, highest_y_m = 0.0, highest_z_m = 0.0;
  double time_limit_s = 0.0, seed = 0.0;
  double command_latency_s = 0.0;  ///< NaN: measured
  std::vector<double> numbers;     ///< of the planner's own parameters, in their order
  std::vector<std::string> texts;  ///< likewise
};

struct OdometryTopic {
  std::string topic, frame, child_frame;
  bool body_velocity = false;  ///< as ROS's convention has it; most planners want the world's
  bool all_states = false;     ///< one for each state since the last call, not the newest alone
};
struct PoseTopic {
  std::string topic, frame;
  bool all_states = false;
};
/// The vehicle in the world, and a camera on the vehicle where it has a name.
struct TransformTopic {
  std::string topic, frame, child_frame, camera_frame;
  std::uint32_t camera = 0;
};
enum class PoseType { pose_stamped, odometry, transform_stamped };
struct CameraPoseTopic {
  std::string topic, frame;
  PoseType type = PoseType::pose_stamped;
  std::uint32_t camera = 0;
};
enum class PixelFormat { float_m, unsigned_mm };
struct DepthTopic {
  std::string topic, frame, info_topic;
  PixelFormat format = PixelFormat::float_m;
  double no_return_m = 0.0, invalid_m = 0.0;
  std::uint32_t camera = 0;
};
struct CloudTopic {
  std::string topic, frame;
  int stride_px = 1;
  std::uint32_t camera = 0;
};
/// Whose coordinates points have. Body and lidar are those of the sweep's end, of a lidar that does
/// not de-skew those of each point's own time.
enum class PointsIn { world, body, lidar };
/// Sweeps of a lidar.
struct SweepTopic {
  std::string topic, frame;
  PointsIn points_in = PointsIn::world;
  std::uint32_t lidar = 0;
};
struct PictureTopic {
  std::string topic, frame, info_topic;
  int eye = 0;  ///< 0: left, 1: right, 2: colour
  std::uint32_t camera = 0;
};
enum class GoalType { pose_stamped, point_stamped, path, pose };
struct GoalTopic {
  std::string topic, frame;
  GoalType type = GoalType::pose_stamped;
  double repeat_s = 0.0;
};

/// A message of any type: a goal, a trigger, a heartbeat.
struct MessageTopic {
  std::string topic;
  bool at_start = false;  ///< when the nodes start; else with the goal, again where that changes
  double every_s = 0.0;   ///< from then on; 0: once
  /// What publishes it, with the numbers that `given` has then.
  std::function<void()> (*advertise)(ros::NodeHandle& host, const Given& given) = nullptr;
};

struct CommandForm {
  std::string topic;
  bool body_velocity = false;
  double hover_thrust = 0.0;  ///< the message's thrust at which the vehicle hovers
  double stale_s = 0.5;
};

struct PlannerSpec {
  std::size_t compute_clock = 0;  ///< which of the parameters is compute_clock_us
  std::vector<NodeSpec> nodes;
  std::vector<std::pair<std::string, std::string>> packages;
  double lead_s = 0.0;
  std::vector<OdometryTopic> odometry;
  std::vector<PoseTopic> poses, twists, imu;
  std::vector<TransformTopic> transforms;
  std::vector<CameraPoseTopic> camera_poses;
  std::vector<DepthTopic> depth;
  std::vector<CloudTopic> clouds;
  std::vector<SweepTopic> sweeps;
  std::vector<PictureTopic> pictures;
  std::vector<GoalTopic> goals;
  std::vector<MessageTopic> messages;
  CommandForm command;
  /// The nodes' own world: where its origin lies, m, and how it is turned, rad; null: avoidbench's.
  std::array<double, 4> (*world)(const Given& given) = nullptr;
  /// Puts the parameters of all nodes into the parameter server.
  void (*set_parameters)(const Given& given) = nullptr;
  /// Subscribes to the command's topic.
  ros::Subscriber (*subscribe)(ros::NodeHandle& host, const CommandForm& form,
                               std::function<void(SetPoints)> take) = nullptr;
};

/// Written by make_planner.py.
PlannerSpec planner_spec();
extern const ab_planner planner_table;

// what the table of a planner is made of
void* create(const ab_host* host, const ab_setup* setup);
void destroy(void* instance);
ab_status reset(void* instance, const ab_mission* mission);
ab_status plan(void* instance, const ab_observation* observation, ab_command* command);

}  // namespace ros_shim
