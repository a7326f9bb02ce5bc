#include "control/tracking.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "control/lee_controller.hpp"
#include "control/mixer.hpp"
#include "control/position_controller.hpp"
#include "control/rate_controller.hpp"
#include "control/trajectory.hpp"
#include "geometry/pose.hpp"
#include "vehicle/dynamics.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// A reference that runs away from a vehicle that can't follow (wind, a push) is kept this near.
constexpr double kLeashM = 2.0;

/// The reference that the vehicle itself would be: where one begins that did not lead it before.
Reference reference_from(const VehicleModel& model, const VehicleState& state) {
  Reference reference;
  reference.position_world = state.position_world;
  reference.velocity_world = state.velocity_world;
  // Without wind, which the vehicle does not know.
  const Vector3d acceleration = acceleration_world(model, state, Environment{});
  const double most = model.spec.max_acceleration_mps2;
  const double size = acceleration.norm();
  reference.acceleration_world =
      size > most ? Vector3d(acceleration * (most / size)) : acceleration;
  reference.yaw_rad = yaw_of(state.q_world_body);
  // The yaw rate is about the world's vertical.
  reference.yaw_rate_radps = (state.q_world_body * state.rates_body).z();
  return reference;
}

GovernorTarget braking() { return {}; }

void go_to_target(Tracker& tracker, const GovernorTarget& target) {
  tracker.target = target;
  tracker.following_trajectory = false;
  tracker.following_rates = false;
}

GovernorTarget governor_target(const Command& command) {
  GovernorTarget target;
  target.yaw_is_rate = command.yaw_is_rate;
  target.yaw = command.yaw_is_rate ? command.yaw_rate_radps : command.yaw_rad;
  switch (command.kind) {
    case CommandKind::position:
      target.goal = GovernorGoal::position;
      target.value_world = command.position_world;
      break;
    case CommandKind::acceleration:
      target.goal = GovernorGoal::acceleration;
      target.value_world = command.acceleration_world;
      break;
    default:
      target.goal = GovernorGoal::velocity;
      target.value_world = command.velocity_world;
  }
  return target;
}

/// Rates and thrust go to the inner loop as they are, but for the vehicle's limits.
void follow_rates(Tracker& tracker, const VehicleModel& model, const Command& command) {
  tracker.following_rates = true;
  tracker.following_trajectory = false;
  for (int i = 0; i < 3; ++i) {
    const double most = model.spec.max_rates_radps[static_cast<std::size_t>(i)];
    tracker.rate_target.rates_body_radps[i] =
        std::min(std::max(command.rates_body_radps[i], -most), most);
  }
  const double most = model.max_rotor_thrust_n * model.rotor_count * model.inverse_mass;
  tracker.rate_target.thrust_mps2 = std::min(std::max(command.thrust_mps2, 0.0), most);
}

void follow_trajectory(Tracker& tracker) {
  tracker.following_trajectory = true;
  tracker.following_rates = false;
  tracker.piece = 0;
  std::vector<TrajectoryPoint>& points = tracker.command.trajectory;
  if (points.front().time_s > 0.0) {
    const Reference& now = tracker.reference;
    // A trajectory that begins later is joined by a piece from the present reference.
    const TrajectoryPoint first{0.0,
                                now.position_world,
                                now.velocity_world,
                                now.acceleration_world,
                                Vector3d::Zero(),
                                now.yaw_rad,
                                now.yaw_rate_radps};
    points.insert(points.begin(), first);
  }
}

/// Brings the reference to the state's tick.
void advance_reference(Tracker& tracker, const VehicleModel& model, const VehicleState& state) {
  const double dt_s = seconds(state.tick - tracker.reference_tick);
  tracker.reference_tick = state.tick;
  // A planner that falls silent leaves a vehicle that brakes, not one that flies on.
  if (tracker.horizon_tick > 0 && state.tick >= tracker.horizon_tick) hold(tracker, model, state);
  if (tracker.following_rates) {
    // Under body rates nothing leads; the next command begins from the vehicle.
    tracker.reference = reference_from(model, state);
    return;
  }
  if (tracker.following_trajectory) {
    const double time_s = seconds(state.tick - tracker.command.start_tick);
    const std::vector<TrajectoryPoint>& points = tracker.command.trajectory;
    tracker.reference = sample_trajectory(points, time_s, tracker.piece);
    // Flown to its end: rest at the last point.
    if (time_s >= points.back().time_s) {
      go_to_target(tracker, {GovernorGoal::position, points.back().position_world, false,
                             points.back().yaw_rad});
    }
    return;
  }
  if (dt_s <= 0.0) return;
  tracker.reference = governed(model, tracker.reference, tracker.target, dt_s);
  // A position command has its own place to come back to; velocity and acceleration have none.
  if (tracker.target.goal != GovernorGoal::position) {
    const Vector3d lead = tracker.reference.position_world - state.position_world;
    const double distance = lead.norm();
    if (distance > kLeashM) {
      tracker.reference.position_world = state.position_world + (kLeashM / distance) * lead;
    }
  }
}

/// Position and attitude in one loop, down to the rotors' commands.
void track_by_lee(Tracker& tracker, const VehicleModel& model, const VehicleState& state) {
  if (state.tick < tracker.next_position_tick) return;
  const ThrustAndTorque wanted = lee_control(model, state, tracker.reference);
  tracker.rotor_command_radps = mix(model, wanted.thrust_n, wanted.torque_body_nm);
  tracker.next_position_tick =
      // From the tick when it was due, so that the rate holds on the mean; never twice at one tick.
      std::max(tracker.next_position_tick + model.lee_period, state.tick + 1);
}

}  // namespace

Tracker make_tracker(const VehicleModel& model, const VehicleState& initial) {
  Tracker tracker;
  tracker.target = braking();
  tracker.reference = reference_from(model, initial);
  tracker.rotor_command_radps = model.hover_speed_radps;
  tracker.rate_target.thrust_mps2 = model.spec.gravity_mps2;
  tracker.reference_tick = initial.tick;
  tracker.next_position_tick = initial.tick;
  tracker.next_rate_tick = initial.tick;
  return tracker;
}

void accept(Tracker& tracker, const VehicleModel& model, const Command& command,
            const VehicleState& state) {
  // The plugin room refused what is wrong with a planner's command; here it would be a fault of
  // ours.
  AB_CHECK(command_problem(command).empty(), command_problem(command));
  AB_CHECK(state.tick >= tracker.reference_tick, state.tick, tracker.reference_tick);
  // Up to now by the old command; from now on by the new one.
  advance_reference(tracker, model, state);
  tracker.command = command;
  tracker.horizon_tick =
      command.horizon_s > 0.0 ? command.start_tick + ticks(command.horizon_s) : 0;
  if (command.kind == CommandKind::rates) {
    follow_rates(tracker, model, command);
  } else if (command.kind == CommandKind::trajectory) {
    follow_trajectory(tracker);
  } else {
    go_to_target(tracker, governor_target(command));
  }
  // A new command is not kept waiting for the controllers' own rate.
  tracker.next_position_tick = state.tick;
  tracker.next_rate_tick = state.tick;
}

void hold(Tracker& tracker, const VehicleModel& model, const VehicleState& state) {
  tracker.horizon_tick = 0;
  if (tracker.following_rates) tracker.reference = reference_from(model, state);
  go_to_target(tracker, braking());
}

void advance(Tracker& tracker, const VehicleModel& model, const VehicleState& state) {
  advance_reference(tracker, model, state);
}

RotorVector track(Tracker& tracker, const VehicleModel& model, const VehicleState& state) {
  AB_CHECK(state.tick >= tracker.reference_tick, state.tick, tracker.reference_tick);
  advance_reference(tracker, model, state);
  if (!tracker.following_rates && model.spec.controller == Controller::lee) {
    track_by_lee(tracker, model, state);
    return tracker.rotor_command_radps;
  }
  // Outer loop, at its own rate: rates and thrust for the inner one.
  if (!tracker.following_rates && state.tick >= tracker.next_position_tick) {
    tracker.rate_target = position_control(model, state, tracker.reference);
    tracker.next_position_tick =
        std::max(tracker.next_position_tick + model.position_period, state.tick + 1);
  }
  if (state.tick >= tracker.next_rate_tick) {
    tracker.rotor_command_radps = rate_control(model, state, tracker.rate_target);
    tracker.next_rate_tick = std::max(tracker.next_rate_tick + model.rate_period, state.tick + 1);
  }
  return tracker.rotor_command_radps;
}

}  // namespace avoidbench
