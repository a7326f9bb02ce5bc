#pragma once

#include <functional>
#include <vector>

#include "control/tracking.hpp"
#include "support/vehicles.hpp"
#include "vehicle/dynamics.hpp"

namespace avoidbench {

/// A flight of 1 ms steps under one command from a hover; `seen` is called after each step.
inline VehicleState fly(const VehicleModel& model, const VehicleState& start,
                        const Command& command, double duration_s,
                        const std::function<void(const Tracker&, const VehicleState&)>& seen = {},
                        const Environment& environment = {}) {
  VehicleState state = start;
  Tracker tracker = make_tracker(model, state);
  accept(tracker, model, command, state);
  const auto steps = static_cast<int>(duration_s * 1000);
  for (int i = 0; i < steps; ++i) {
    const RotorVector rotors = track(tracker, model, state);
    if (seen) seen(tracker, state);
    state = step(model, state, rotors, environment, kTicksPerMillisecond);
  }
  return state;
}

inline Command go_to(const Eigen::Vector3d& position_world, double yaw_rad = 0.0) {
  Command command;
  command.kind = CommandKind::position;
  command.position_world = position_world;
  command.yaw_rad = yaw_rad;
  return command;
}

inline Command fly_at(const Eigen::Vector3d& velocity_world, double yaw_rad = 0.0) {
  Command command;
  command.kind = CommandKind::velocity;
  command.velocity_world = velocity_world;
  command.yaw_rad = yaw_rad;
  return command;
}

/// A horizontal circle about the origin at 2 m height, from (radius, 0, 2), heading along the
/// flight.
inline Command circle(double radius_m, double speed_mps, double duration_s, double period_s) {
  Command command;
  command.kind = CommandKind::trajectory;
  const double rate = speed_mps / radius_m;
  for (int i = 0; i * period_s <= duration_s; ++i) {
    const double t = i * period_s;
    const double c = std::cos(rate * t), s = std::sin(rate * t);
    TrajectoryPoint point;
    point.time_s = t;
    point.position_world = {radius_m * c, radius_m * s, 2.0};
    point.velocity_world = {-speed_mps * s, speed_mps * c, 0.0};
    point.acceleration_world = {-speed_mps * rate * c, -speed_mps * rate * s, 0.0};
    point.yaw_rad = rate * t + M_PI / 2;
    point.yaw_rate_radps = rate;
    command.trajectory.push_back(point);
  }
  return command;
}

}  // namespace avoidbench
