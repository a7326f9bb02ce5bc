#include "trial/planner_view.hpp"

#include <utility>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/random.hpp"
#include "trial/lidar_sensing.hpp"

namespace avoidbench {
namespace {

Eigen::Vector3d vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

CommandKind command_kind(std::uint32_t kind) {
  switch (kind) {
    case AB_COMMAND_POSITION:
      return CommandKind::position;
    case AB_COMMAND_VELOCITY:
      return CommandKind::velocity;
    case AB_COMMAND_ACCELERATION:
      return CommandKind::acceleration;
    case AB_COMMAND_TRAJECTORY:
      return CommandKind::trajectory;
    // command_problem() has refused all that is no kind.
    default:
      AB_CHECK(kind == AB_COMMAND_RATES, kind);
      return CommandKind::rates;
  }
}

}  // namespace

std::optional<double> known_latency_s(const LatencySpec& latency) {
  if (is_measured(latency)) return std::nullopt;
  // By way of ticks: what planners are told is what is flown.
  return latency.mode == LatencyMode::fixed ? seconds(ticks(latency.ms / 1000.0)) : 0.0;
}

SensorSpec seen_sensor(const TrialSpec& spec) {
  if (spec.planner.camera == kAllCameras) return spec.sensor;
  return one_camera(spec.sensor, static_cast<std::size_t>(spec.planner.camera));
}

PlannerSetup planner_setup(const TrialSpec& spec) {
  PlannerSetup setup;
  setup.max_speed_mps = spec.vehicle.max_speed_mps;
  setup.max_acceleration_mps2 = spec.vehicle.max_acceleration_mps2;
  setup.max_yaw_rate_radps = spec.vehicle.max_yaw_rate_radps;
  setup.body_size_m = to_eigen(spec.vehicle.body_size_m);
  setup.plan_period_s = 1.0 / spec.rates.plan_hz;
  setup.gravity_mps2 = spec.vehicle.gravity_mps2;
  for (const auto& [kind, mounting] : rig_cameras(seen_sensor(spec))) {
    const Pinhole camera = sensor_camera(kind);
    setup.cameras.push_back({.width_px = camera.width_px,
                             .height_px = camera.height_px,
                             .fx_px = camera.fx_px,
                             .fy_px = camera.fy_px,
                             .cx_px = camera.cx_px,
                             .cy_px = camera.cy_px,
                             .T_body_camera = T_body_camera(mounting),
                             .rate_hz = kind.rate_hz,
                             .min_range_m = kind.min_range_m,
                             .max_range_m = kind.max_range_m,
                             .baseline_m = kind.baseline_m});
  }
  setup.lidars = lidar_setups(spec.sensor);
  return setup;
}

std::vector<ParameterValue> parameter_values(const PluginChoice& plugin) {
  std::vector<ParameterValue> values;
  for (const ParameterChoice& choice : plugin.parameters) {
    values.push_back({.number = choice.number, .text = choice.text});
  }
  return values;
}

PlannerMission planner_mission(const TrialSpec& spec, const Mission& mission, const Aabb& bounds) {
  // By map and mission and not by planner: two planners that draw alike meet the same luck.
  const std::uint64_t map_stream = stream_seed(stream_seed(spec.seed, "planner"), spec.map_seed);
  std::vector<Eigen::Vector3d> goals = goals_of(mission);
  const Eigen::Vector3d first = goals.front();
  return {.seed = stream_seed(map_stream, static_cast<std::uint64_t>(spec.mission_index)),
          .start_world = mission.start_world,
          .goal_world = first,
          .start_yaw_rad = mission.start_yaw_rad,
          .goal_radius_m = spec.mission.goal_radius_m,
          .time_limit_s = spec.mission.time_limit_s,
          .lowest_world = bounds.min(),
          .highest_world = bounds.max(),
          .command_latency_s = known_latency_s(spec.latency).value_or(math::kNaN),
          .goals_world = std::move(goals)};
}

Command vehicle_command(const PlanResult& result, Tick start_tick) {
  Command command;
  command.kind = command_kind(result.command.kind);
  command.position_world = vector(result.command.position_world_m);
  command.velocity_world = vector(result.command.velocity_world_mps);
  command.acceleration_world = vector(result.command.acceleration_world_mps2);
  command.yaw_rad = result.command.yaw_rad;
  command.yaw_rate_radps = result.command.yaw_rate_radps;
  command.yaw_is_rate = (result.command.flags & AB_YAW_IS_RATE) != 0;
  command.rates_body_radps = vector(result.command.rates_body_radps);
  command.thrust_mps2 = result.command.thrust_mps2;
  command.horizon_s = result.command.horizon_s;
  command.start_tick = start_tick;
  for (const ab_point& point : result.points) {
    command.trajectory.push_back({.time_s = point.time_s,
                                  .position_world = vector(point.position_world_m),
                                  .velocity_world = vector(point.velocity_world_mps),
                                  .acceleration_world = vector(point.acceleration_world_mps2),
                                  .jerk_world = vector(point.jerk_world_mps3),
                                  .yaw_rad = point.yaw_rad,
                                  .yaw_rate_radps = point.yaw_rate_radps});
  }
  return command;
}

}  // namespace avoidbench
