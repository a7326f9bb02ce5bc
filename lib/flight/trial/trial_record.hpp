#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/enum_text.hpp"

namespace avoidbench {

/// How a trial ended.
enum class Outcome {
  reached_goal,
  collided,
  left_bounds,
  timed_out,
  planner_gave_up,
  planner_error,
  planner_crashed,
  planner_hung
};

template <>
struct EnumText<Outcome> {
  static constexpr std::pair<Outcome, std::string_view> entries[] = {
      {Outcome::reached_goal, "reached_goal"},       {Outcome::collided, "collided"},
      {Outcome::left_bounds, "left_bounds"},         {Outcome::timed_out, "timed_out"},
      {Outcome::planner_gave_up, "planner_gave_up"}, {Outcome::planner_error, "planner_error"},
      {Outcome::planner_crashed, "planner_crashed"}, {Outcome::planner_hung, "planner_hung"}};
};

/// The vehicle at one moment of the recorded trajectory. Plain doubles in this order are the stored
/// format.
struct Sample {
  double time_s = 0.0;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_world = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_world_body = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rates_body_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d reference_world = Eigen::Vector3d::Constant(
      std::numeric_limits<double>::quiet_NaN());  ///< commanded position; NaN: there is none
  double clearance_m = 0.0;  ///< body box to the nearest surface, at most kClearanceLimit_m
  double rotor_power_w = 0.0;
};

inline constexpr double kClearanceLimit_m = 5.0;

/// One call of the planner.
struct PlanCall {
  double time_s = 0.0;      ///< simulated time of what it saw
  double cpu_time_s = 0.0;  ///< measured by the host; differs from run to run
  double wall_time_s = 0.0;
  std::int32_t status = 0;  ///< AB_OK, AB_NO_PLAN, …
  std::uint32_t command_kind = 0;
  /// That its command took effect after what it saw, whole ticks; NaN where the spec says it.
  double latency_s = std::numeric_limits<double>::quiet_NaN();
};

/// A touch with a surface.
struct Collision {
  double time_s = 0.0;
  double speed_mps = 0.0;
  std::int64_t obstacle = -1;  ///< index into World::obstacles
  std::string kind;            ///< of the obstacle
};

/// All that is known of one flown trial.
struct TrialRecord {
  Outcome outcome = Outcome::timed_out;
  std::string reason;  ///< one line for people
  double end_time_s = 0.0;
  std::vector<Sample> samples;
  std::vector<PlanCall> plan_calls;
  std::vector<Collision> collisions;
};

}  // namespace avoidbench
